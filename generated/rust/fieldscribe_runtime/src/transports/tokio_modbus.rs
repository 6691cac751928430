// SPDX-License-Identifier: 0BSD
//! A client of tokio-modbus 0.17 as a transport. Needs the feature `tokio-modbus`.

use std::io::{Error, ErrorKind};
use std::time::Duration;
use std::vec::Vec;

use ::tokio_modbus::client::{Client, Context};
use ::tokio_modbus::slave::SlaveContext;
use ::tokio_modbus::{ExceptionResponse, ProtocolError, Request, Response, Slave};

use crate::modbus::{crc, framing_of, Framing};
use crate::AsyncTransport;

/// A client of tokio-modbus, over TCP, a serial line or RTU over TCP.
///
/// Our frames reach it as requests, its answers come back as frames; the framing on the wire is its own affair, and
/// ours may be either. After a failure nobody knows which request a later answer is for. So the
/// client is given up then, and each exchange fails with [`ErrorKind::NotConnected`] until it gets another:
/// [`Attached::attach`]. The same holds if the future of an exchange was dropped. A serial port is held until it is
/// closed: [`Attached::detach`] before it is opened anew.
pub struct Attached {
    context: Option<Context>,
    timeout: Duration,
    is_given_up: bool,
}

impl Attached {
    /// A client, with a second for each answer.
    #[must_use]
    pub const fn new(context: Context) -> Self {
        Self {
            context: Some(context),
            timeout: Duration::from_secs(1),
            is_given_up: false,
        }
    }

    /// The same with another time for each answer. As long all units have to do what goes to all of them.
    #[must_use]
    pub fn timeout(self, timeout: Duration) -> Self {
        Self { timeout, ..self }
    }

    /// Takes another client.
    pub fn attach(&mut self, context: Context) {
        self.context = Some(context);
        self.is_given_up = false;
    }

    /// Gives the client up, which closes its port, as before a serial port is opened anew; the next exchanges fail
    /// until there is another client.
    pub fn detach(&mut self) {
        self.context = None;
        self.is_given_up = true;
    }

    /// The client of tokio-modbus, as for functions that are none of ours; none after [`Attached::detach`].
    pub fn context(&mut self) -> Option<&mut Context> {
        self.context.as_mut()
    }

    /// The data of the answer, with the function before them; none if none came in time.
    async fn call(
        &mut self,
        unit: u8,
        function: u8,
        data: &[u8],
    ) -> Result<Option<Vec<u8>>, Error> {
        let context = self.context.as_mut().ok_or(ErrorKind::NotConnected)?;
        context.set_slave(Slave(unit));
        let asked = context.call(Request::Custom(function, data.into()));
        let Ok(answered) = ::tokio::time::timeout(self.timeout, asked).await else {
            return Ok(None);
        };
        // Since the request is one of bytes, tokio-modbus calls a well-known answer another function's, and brings it.
        let answer = match answered {
            Ok(answer) => answer.map_err(|exception| ExceptionResponse {
                function: ::tokio_modbus::FunctionCode::Custom(function),
                exception,
            }),
            Err(::tokio_modbus::Error::Protocol(ProtocolError::FunctionCodeMismatch {
                result,
                ..
            })) => result,
            Err(::tokio_modbus::Error::Protocol(other)) => {
                return Err(Error::new(ErrorKind::InvalidData, other))
            }
            Err(::tokio_modbus::Error::Transport(error)) => return Err(error),
        };
        pdu(answer).map(Some)
    }
}

impl AsyncTransport for Attached {
    type Error = Error;

    async fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Error> {
        if core::mem::replace(&mut self.is_given_up, true) {
            return Err(ErrorKind::NotConnected.into());
        }
        let framing = framing_of(request);
        let whole = match framing {
            Framing::Rtu => request.get(..request.len().saturating_sub(2)),
            Framing::Tcp => request.get(6..),
        };
        let Some(&[unit, function, ref data @ ..]) = whole else {
            return Err(ErrorKind::InvalidInput.into());
        };
        let answer = self.call(unit, function, data).await?;
        self.is_given_up = answer.is_none() && !reply.is_empty();
        if reply.is_empty() {
            return Ok(0);
        }
        let mut frame = Vec::from([unit]);
        frame.extend(answer.ok_or(ErrorKind::TimedOut)?);
        put(&framed(framing, request, frame), reply)
    }
}

/// The bytes of an answer, as they stood in its frame.
fn pdu(answer: Result<Response, ExceptionResponse>) -> Result<Vec<u8>, Error> {
    let answer = match answer {
        Ok(answer) => answer,
        Err(refused) => {
            let function = refused.function.value() | 0x80;
            return Ok(Vec::from([function, refused.exception.into()]));
        }
    };
    let function = answer.function_code().value();
    let mut bytes = Vec::from([function]);
    match answer {
        Response::ReadCoils(bits) | Response::ReadDiscreteInputs(bits) => {
            let packed = bits.chunks(8).map(|bits| {
                bits.iter()
                    .rev()
                    .fold(0, |byte, bit| byte << 1 | u8::from(*bit))
            });
            bytes.push(counted(bits.len().div_ceil(8))?);
            bytes.extend(packed);
        }
        Response::ReadHoldingRegisters(words) | Response::ReadInputRegisters(words) => {
            bytes.push(counted(words.len().saturating_mul(2))?);
            bytes.extend(words.into_iter().flat_map(u16::to_be_bytes));
        }
        Response::WriteSingleCoil(address, is_on) => {
            bytes.extend(address.to_be_bytes());
            bytes.extend(if is_on { [0xFF, 0] } else { [0, 0] });
        }
        Response::WriteSingleRegister(address, word)
        | Response::WriteMultipleCoils(address, word)
        | Response::WriteMultipleRegisters(address, word) => {
            bytes.extend(address.to_be_bytes());
            bytes.extend(word.to_be_bytes());
        }
        Response::Custom(_, data) => bytes.extend(data),
        _ => return Err(ErrorKind::InvalidData.into()),
    }
    Ok(bytes)
}

fn counted(bytes: usize) -> Result<u8, Error> {
    u8::try_from(bytes).map_err(|_| ErrorKind::InvalidData.into())
}

/// The frame of the answer, in the request's framing and transaction.
fn framed(framing: Framing, request: &[u8], mut frame: Vec<u8>) -> Vec<u8> {
    match framing {
        Framing::Rtu => {
            frame.extend(crc(&frame).to_le_bytes());
            frame
        }
        Framing::Tcp => {
            let mut whole = Vec::from(request.get(..4).unwrap_or_default());
            whole.extend(u16::try_from(frame.len()).unwrap_or(u16::MAX).to_be_bytes());
            whole.append(&mut frame);
            whole
        }
    }
}

fn put(frame: &[u8], reply: &mut [u8]) -> Result<usize, Error> {
    let space = reply.get_mut(..frame.len()).ok_or(ErrorKind::InvalidData)?;
    space.copy_from_slice(frame);
    Ok(frame.len())
}
