// SPDX-License-Identifier: 0BSD
//! Transports of families that ask and answer, which the caller brings. Nothing here does input or output itself.
//!
//! The clients of the other families are in [`crate::uss`] and [`crate::can`].

use core::future::Future;

pub use crate::modbus::{AsyncClient, Client, ClientError};

/// Sends a request and waits for its reply.
pub trait Transport {
    /// What can go wrong on the line.
    type Error;

    /// Sends `request`, puts the reply into `reply` and gives its length in bytes.
    ///
    /// What came before the request is to be thrown away first: a late answer to an earlier request, which was
    /// given up, could else be taken for the answer to this one, as nothing in it tells them apart.
    ///
    /// An empty `reply` says that none will come: the request went to all units.
    ///
    /// # Errors
    /// Whatever went wrong on the line, also that nothing came in time.
    fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Self::Error>;
}

/// Sends a request and waits for its reply without blocking.
pub trait AsyncTransport {
    /// What can go wrong on the line.
    type Error;

    /// As [`Transport::exchange`].
    ///
    /// A future that is dropped gives the request up.
    fn exchange(
        &mut self,
        request: &[u8],
        reply: &mut [u8],
    ) -> impl Future<Output = Result<usize, Self::Error>>;
}

/// Several clients share one bus: each borrows it for as long as it lives.
impl<T: Transport + ?Sized> Transport for &mut T {
    type Error = T::Error;

    fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, Self::Error> {
        (**self).exchange(request, reply)
    }
}

/// As for [`Transport`].
impl<T: AsyncTransport + ?Sized> AsyncTransport for &mut T {
    type Error = T::Error;

    fn exchange(
        &mut self,
        request: &[u8],
        reply: &mut [u8],
    ) -> impl Future<Output = Result<usize, Self::Error>> {
        (**self).exchange(request, reply)
    }
}
