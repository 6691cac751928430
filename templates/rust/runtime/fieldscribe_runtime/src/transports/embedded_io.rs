// SPDX-License-Identifier: 0BSD
//! Ports of embedded-io 0.7, as a UART. Needs the feature `embedded-io`.

use ::embedded_io::{Read, ReadReady, Write};

use super::{Answer, LineError, Protocol, NOISE};
use crate::Transport;

/// A port that tells whether bytes have arrived, and a closure to call while it waits.
///
/// After a missing reply, it waits once more before the next request, so that no late reply is taken for another.
///
/// `wait` is called while nothing comes, with how often that was so in a row; it gives whether to go on waiting:
///
/// ```
/// use fieldscribe_runtime::transports::embedded_io::Line;
/// # use embedded_io::{ErrorType, Read, ReadReady, Write};
/// # struct Uart;
/// # impl ErrorType for Uart { type Error = embedded_io::ErrorKind; }
/// # impl Read for Uart { fn read(&mut self, _: &mut [u8]) -> Result<usize, Self::Error> { Ok(0) } }
/// # impl ReadReady for Uart { fn read_ready(&mut self) -> Result<bool, Self::Error> { Ok(false) } }
/// # impl Write for Uart {
/// #     fn write(&mut self, bytes: &[u8]) -> Result<usize, Self::Error> { Ok(bytes.len()) }
/// #     fn flush(&mut self) -> Result<(), Self::Error> { Ok(()) }
/// # }
/// # struct Delay;
/// # impl Delay { fn delay_us(&mut self, _: u32) {} }
/// # let (uart, mut delay) = (Uart, Delay);
///
/// let line = Line::new(uart, |waited| {
///     delay.delay_us(100);
///     waited < 5_000 // half a second
/// });
/// ```
#[derive(Debug)]
pub struct Line<P, W> {
    port: P,
    wait: W,
    protocol: Protocol,
    is_late: bool,
}

impl<P, W: FnMut(u32) -> bool> Line<P, W> {
    /// A line of Modbus.
    pub const fn new(port: P, wait: W) -> Self {
        Self::speaking(Protocol::Modbus, port, wait)
    }

    /// A line with this protocol.
    pub const fn speaking(protocol: Protocol, port: P, wait: W) -> Self {
        Self {
            port,
            wait,
            protocol,
            is_late: false,
        }
    }

    /// The port, for example to change its settings.
    pub fn port(&mut self) -> &mut P {
        &mut self.port
    }
}

impl<P: Read + ReadReady + Write, W: FnMut(u32) -> bool> Line<P, W> {
    /// Whether bytes have arrived; with `waits`, it waits for them.
    fn is_ready(&mut self, waits: bool) -> Result<bool, P::Error> {
        let mut waited = 0_u32;
        while !self.port.read_ready()? {
            if !waits || !(self.wait)(waited) {
                return Ok(false);
            }
            waited = waited.wrapping_add(1);
        }
        Ok(true)
    }
}

impl<P: Read + ReadReady + Write, W: FnMut(u32) -> bool> Transport for Line<P, W> {
    type Error = LineError<P::Error>;

    fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Self::Error> {
        let mut thrown_away = [0; 64];
        for _ in 0..NOISE {
            if !self.is_ready(self.is_late)? || self.port.read(&mut thrown_away)? == 0 {
                break;
            }
        }
        self.port.write_all(request)?;
        self.port.flush()?;
        let mut answer = Answer::new(self.protocol, request, reply);
        self.is_late = false;
        while let Some(space) = answer.space() {
            if !self.is_ready(true)? {
                self.is_late = true;
                if answer.length() == 0 {
                    return Err(LineError::TimedOut);
                }
                break; // the reply is cut
            }
            match self.port.read(space)? {
                0 => return Err(LineError::Closed),
                count => answer.took(count),
            }
        }
        Ok(answer.length())
    }
}
