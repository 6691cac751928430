//! A port of embedded-io and embedded-io-async over a line in memory.

use std::collections::VecDeque;
use std::future::poll_fn;
use std::task::Poll;

use fieldscribe_runtime::modbus::crc;

/// A UART on whose line somebody answers each request with the next bytes, if there are any.
#[derive(Default)]
pub struct Uart {
    pub came: VecDeque<u8>,
    pub sent: Vec<u8>,
    answers: VecDeque<Vec<u8>>,
}

impl Uart {
    #[must_use]
    pub fn new(answers: &[&[u8]]) -> Self {
        Self { answers: answers.iter().map(|answer| answer.to_vec()).collect(), ..Self::default() }
    }

    fn take(&mut self, bytes: &mut [u8]) -> usize {
        bytes[0] = self.came.pop_front().unwrap(); // as a UART without a buffer does
        1
    }

    fn answer(&mut self) {
        self.came.extend(self.answers.pop_front().unwrap_or_default());
    }
}

impl embedded_io::ErrorType for Uart {
    type Error = embedded_io::ErrorKind;
}

impl embedded_io::Read for Uart {
    fn read(&mut self, bytes: &mut [u8]) -> Result<usize, Self::Error> {
        Ok(self.take(bytes))
    }
}

impl embedded_io::ReadReady for Uart {
    fn read_ready(&mut self) -> Result<bool, Self::Error> {
        Ok(!self.came.is_empty())
    }
}

impl embedded_io::Write for Uart {
    fn write(&mut self, bytes: &[u8]) -> Result<usize, Self::Error> {
        self.sent.push(bytes[0]);
        Ok(1)
    }

    fn flush(&mut self) -> Result<(), Self::Error> {
        self.answer();
        Ok(())
    }
}

impl embedded_io_async::Read for Uart {
    async fn read(&mut self, bytes: &mut [u8]) -> Result<usize, Self::Error> {
        poll_fn(|_| if self.came.is_empty() { Poll::Pending } else { Poll::Ready(()) }).await;
        Ok(self.take(bytes))
    }
}

impl embedded_io_async::Write for Uart {
    async fn write(&mut self, bytes: &[u8]) -> Result<usize, Self::Error> {
        self.sent.push(bytes[0]);
        Ok(1)
    }

    async fn flush(&mut self) -> Result<(), Self::Error> {
        self.answer();
        Ok(())
    }
}

/// The answer of unit 1 to a read of one word.
#[must_use]
pub fn word(word: u8) -> Vec<u8> {
    let mut reply = vec![1, 3, 2, 0, word];
    reply.extend(crc(&reply).to_le_bytes());
    reply
}
