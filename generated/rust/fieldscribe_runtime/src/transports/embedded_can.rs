// SPDX-License-Identifier: 0BSD
//! Controllers of embedded-can 0.4. Needs the feature `embedded-can`.

use core::fmt;

use ::embedded_can::{
    blocking, nb as non_blocking, Error, ExtendedId, Frame as Sent, Id, StandardId,
};

use crate::can::{Frame, Profile, Transport};

/// Why a frame could not be sent or received.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum BusError<E> {
    /// The controller failed.
    Bus(E),
    /// The controller does not accept the frame.
    BadFrame,
    /// Nothing arrived in time, or the bus stayed busy.
    TimedOut,
}

impl<E> From<E> for BusError<E> {
    fn from(error: E) -> Self {
        Self::Bus(error)
    }
}

impl<E: Error> fmt::Display for BusError<E> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bus(error) => error.kind().fmt(formatter),
            Self::BadFrame => formatter.write_str("the controller does not take this frame"),
            Self::TimedOut => formatter.write_str("nothing came in time"),
        }
    }
}

impl<E: Error> core::error::Error for BusError<E> {}

/// A blocking controller. It decides how long it waits, and cannot tell which frames have already arrived.
#[derive(Debug)]
pub struct Blocking<C> {
    controller: C,
    is_extended: bool,
}

impl<C: blocking::Can> Blocking<C> {
    /// A controller on the bus of a device with this profile.
    pub const fn new(controller: C, profile: &Profile) -> Self {
        Self {
            controller,
            is_extended: is_extended(profile),
        }
    }

    /// The controller, for example to change its settings.
    pub fn controller(&mut self) -> &mut C {
        &mut self.controller
    }
}

impl<C: blocking::Can> Transport for Blocking<C> {
    type Error = BusError<C::Error>;

    fn send(&mut self, frame: &Frame) -> Result<(), Self::Error> {
        let frame = out_of(frame, self.is_extended).ok_or(BusError::BadFrame)?;
        Ok(self.controller.transmit(&frame)?)
    }

    fn receive(&mut self) -> Result<Frame, Self::Error> {
        loop {
            if let Some(frame) = into(&self.controller.receive()?, self.is_extended) {
                return Ok(frame);
            }
        }
    }

    fn pending(&mut self) -> Result<Option<Frame>, Self::Error> {
        Ok(None)
    }
}

/// A non-blocking controller (`nb`), and a closure to call while it waits.
///
/// `wait` is called with how often that was so in a row; it gives whether to go on waiting.
#[derive(Debug)]
pub struct NonBlocking<C, W> {
    controller: C,
    is_extended: bool,
    wait: W,
}

impl<C: non_blocking::Can, W: FnMut(u32) -> bool> NonBlocking<C, W> {
    /// A controller on the bus of a device with this profile.
    pub const fn new(controller: C, profile: &Profile, wait: W) -> Self {
        Self {
            controller,
            is_extended: is_extended(profile),
            wait,
        }
    }

    /// The controller, for example to change its settings.
    pub fn controller(&mut self) -> &mut C {
        &mut self.controller
    }

    /// Tries until the controller succeeds.
    fn until_done<R>(
        &mut self,
        mut step: impl FnMut(&mut C) -> nb::Result<R, C::Error>,
    ) -> Result<R, BusError<C::Error>> {
        let mut waited = 0_u32;
        loop {
            match step(&mut self.controller) {
                Ok(done) => return Ok(done),
                Err(nb::Error::Other(error)) => return Err(BusError::Bus(error)),
                Err(nb::Error::WouldBlock) if !(self.wait)(waited) => {
                    return Err(BusError::TimedOut)
                }
                Err(nb::Error::WouldBlock) => waited = waited.saturating_add(1),
            }
        }
    }
}

impl<C: non_blocking::Can, W: FnMut(u32) -> bool> Transport for NonBlocking<C, W> {
    type Error = BusError<C::Error>;

    fn send(&mut self, frame: &Frame) -> Result<(), Self::Error> {
        let mut next = Some(out_of(frame, self.is_extended).ok_or(BusError::BadFrame)?);
        // A frame of lower priority may come back for this one; it is sent after it.
        while let Some(frame) = next {
            next = self.until_done(|controller| controller.transmit(&frame))?;
        }
        Ok(())
    }

    fn receive(&mut self) -> Result<Frame, Self::Error> {
        loop {
            let frame = self.until_done(non_blocking::Can::receive)?;
            if let Some(frame) = into(&frame, self.is_extended) {
                return Ok(frame);
            }
        }
    }

    fn pending(&mut self) -> Result<Option<Frame>, Self::Error> {
        loop {
            match self.controller.receive() {
                Ok(frame) => {
                    if let Some(frame) = into(&frame, self.is_extended) {
                        return Ok(Some(frame));
                    }
                }
                Err(nb::Error::WouldBlock) => return Ok(None),
                Err(nb::Error::Other(error)) => return Err(BusError::Bus(error)),
            }
        }
    }
}

const fn is_extended(profile: &Profile) -> bool {
    profile.identifier_bits() > 11
}

/// Our frame as the controller's.
fn out_of<F: Sent>(frame: &Frame, is_extended: bool) -> Option<F> {
    let id = if is_extended {
        Id::from(ExtendedId::new(frame.id())?)
    } else {
        Id::from(StandardId::new(u16::try_from(frame.id()).ok()?)?)
    };
    F::new(id, frame.bytes())
}

/// The controller's frame as ours, if it can be one of the device.
fn into(frame: &impl Sent, is_extended: bool) -> Option<Frame> {
    let id = match frame.id() {
        Id::Standard(id) if !is_extended => u32::from(id.as_raw()),
        Id::Extended(id) if is_extended => id.as_raw(),
        _ => return None,
    };
    frame.is_data_frame().then(|| Frame::new(id, frame.data()))
}
