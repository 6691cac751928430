// SPDX-License-Identifier: 0BSD
//! Ports of embedded-io-async 0.7. Needs the feature `embedded-io-async`.

use core::future::{poll_fn, Future};
use core::pin::pin;
use core::task::Poll;

use ::embedded_io_async::{Read, Write};

use super::{Answer, LineError, Protocol, NOISE};
use crate::LocalTransport;

/// A port whose reads do not block.
///
/// It waits for ever: the time for an answer is the executor's, as `with_timeout(..., client.read::<P>())`. A read of
/// the port that is dropped is to lose no bytes, which holds for ports with a buffer.
#[derive(Debug)]
pub struct Line<P> {
    port: P,
    protocol: Protocol,
}

impl<P> Line<P> {
    /// A line of Modbus.
    pub const fn new(port: P) -> Self {
        Self::speaking(Protocol::Modbus, port)
    }

    /// A line with this protocol.
    pub const fn speaking(protocol: Protocol, port: P) -> Self {
        Self { port, protocol }
    }

    /// The port, for example to change its settings.
    pub fn port(&mut self) -> &mut P {
        &mut self.port
    }
}

impl<P: Read + Write> LocalTransport for Line<P> {
    type Error = LineError<P::Error>;

    async fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Self::Error> {
        for _ in 0..NOISE {
            if !came(&mut self.port).await? {
                break;
            }
        }
        self.port.write_all(request).await?;
        self.port.flush().await?;
        let mut answer = Answer::new(self.protocol, request, reply);
        while let Some(space) = answer.space() {
            match self.port.read(space).await? {
                0 => return Err(LineError::Closed),
                count => answer.took(count),
            }
        }
        Ok(answer.length())
    }
}

/// Discards some received bytes; returns whether there were any.
async fn came<P: Read>(port: &mut P) -> Result<bool, P::Error> {
    let mut thrown_away = [0; 64];
    let mut read = pin!(port.read(&mut thrown_away));
    let asked = poll_fn(|context| match read.as_mut().poll(context) {
        Poll::Ready(count) => Poll::Ready(Some(count)),
        Poll::Pending => Poll::Ready(None),
    });
    asked.await.map_or(Ok(false), |count| Ok(count? > 0))
}
