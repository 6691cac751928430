// SPDX-License-Identifier: 0BSD
//! A client of tokio-modbus 0.17 as a transport. Needs the feature `tokio-modbus`.

use std::boxed::Box;
use std::future::Future;
use std::io::{Error, ErrorKind};
use std::pin::Pin;
use std::time::Duration;
use std::vec::Vec;

use ::tokio_modbus::client::{Client, Context};
use ::tokio_modbus::slave::SlaveContext;
use ::tokio_modbus::{ExceptionResponse, ProtocolError, Request, Response, Slave};

use crate::modbus::{crc, framing_of, Framing};
use crate::AsyncTransport;

type Connecting = Pin<Box<dyn Future<Output = Result<Context, Error>> + Send>>;

/// A client of tokio-modbus, over TCP, a serial line or RTU over TCP.
///
/// Our frames become its requests, and its answers become our frames; it adds its own framing, and ours can be either
/// one. It connects on first use, and again after a failure, because a later answer could be for any request; dropping
/// the future of an exchange is such a failure. The old connection is closed first, so that a serial port is free.
///
/// ```ignore
/// // with the feature `tcp` of tokio-modbus
/// let line = Line::new(|| tokio_modbus::client::tcp::connect(([192, 168, 0, 20], 502).into()));
/// ```
pub struct Line {
    connect: Box<dyn FnMut() -> Connecting + Send>,
    context: Option<Context>,
    timeout: Duration,
    turnaround: Duration,
}

impl Line {
    /// A line that `connect` opens, with one second to connect and for each answer, and 0.1 seconds after a broadcast.
    #[must_use]
    pub fn new<F, E>(mut connect: impl FnMut() -> F + Send + 'static) -> Self
    where
        F: Future<Output = Result<Context, E>> + Send + 'static,
        E: Into<Error>,
    {
        Self {
            connect: Box::new(move || {
                let connecting = connect();
                Box::pin(async move { connecting.await.map_err(Into::into) })
            }),
            context: None,
            timeout: Duration::from_secs(1),
            turnaround: Duration::from_millis(100),
        }
    }

    /// The same with another time to connect, and for each answer.
    #[must_use]
    pub fn timeout(self, timeout: Duration) -> Self {
        Self { timeout, ..self }
    }

    /// The same with another time to send a broadcast, and for the units to carry it out.
    #[must_use]
    pub fn turnaround(self, turnaround: Duration) -> Self {
        Self { turnaround, ..self }
    }

    /// The client of tokio-modbus, for example for other functions; [`None`] before the first exchange and after a
    /// failure.
    pub fn context(&mut self) -> Option<&mut Context> {
        self.context.as_mut()
    }

    /// The present connection, or a new one; the caller holds it until an answer arrives.
    async fn connection(&mut self) -> Result<Context, Error> {
        if let Some(context) = self.context.take() {
            return Ok(context);
        }
        let connecting = ::tokio::time::timeout(self.timeout, (self.connect)());
        connecting.await.map_err(|_| ErrorKind::TimedOut)?
    }
}

impl AsyncTransport for Line {
    type Error = Error;

    async fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Error> {
        let framing = framing_of(request);
        let whole = match framing {
            Framing::Rtu => request.get(..request.len().saturating_sub(2)),
            Framing::Tcp => request.get(6..),
        };
        let Some(&[unit, function, ref data @ ..]) = whole else {
            return Err(ErrorKind::InvalidInput.into());
        };
        let mut context = self.connection().await?;
        let wait = if reply.is_empty() {
            self.turnaround
        } else {
            self.timeout
        };
        let answer = call(&mut context, wait, unit, function, data).await?;
        if answer.is_some() || reply.is_empty() {
            self.context = Some(context);
        }
        if reply.is_empty() {
            return Ok(0);
        }
        let mut frame = Vec::from([unit]);
        frame.extend(answer.ok_or(ErrorKind::TimedOut)?);
        put(&framed(framing, request, frame), reply)
    }
}

/// The data of the answer, with the function before them; [`None`] if none arrived in time.
async fn call(
    context: &mut Context,
    timeout: Duration,
    unit: u8,
    function: u8,
    data: &[u8],
) -> Result<Option<Vec<u8>>, Error> {
    context.set_slave(Slave(unit));
    let asked = context.call(Request::Custom(function, data.into()));
    let Ok(answered) = ::tokio::time::timeout(timeout, asked).await else {
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

/// The bytes of an answer, as in its frame.
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
