// SPDX-License-Identifier: 0BSD
//! Frames as debug messages of the crates `log` and `defmt`, if the feature of that name is on; else nothing.

/// Where a frame goes.
#[derive(Clone, Copy)]
pub(crate) enum Way {
    /// To the unit.
    Sent,
    /// From the unit, as far as its request tells.
    Came,
}

/// Tells of a frame of a unit: which way it goes, and its bytes. A frame of CAN has an identifier.
#[inline]
pub(crate) fn frame(unit: u8, way: Way, id: Option<u32>, bytes: &[u8]) {
    let arrow = match way {
        Way::Sent => "->",
        Way::Came => "<-",
    };
    #[cfg(feature = "log")]
    ::log::debug!(target: "fieldscribe", "unit {unit} {arrow}{}", Shown(id, bytes));
    #[cfg(feature = "defmt")]
    if let Some(id) = id {
        ::defmt::debug!(
            "unit {=u8} {=str} {=u32:X}h {=[u8]:02X}",
            unit,
            arrow,
            id,
            bytes
        );
    } else {
        ::defmt::debug!("unit {=u8} {=str} {=[u8]:02X}", unit, arrow, bytes);
    }
    let _ = (unit, arrow, id, bytes);
}

/// Tells that the line failed with the last frame to a unit.
#[inline]
pub(crate) fn failed(unit: u8) {
    #[cfg(feature = "log")]
    ::log::debug!(target: "fieldscribe", "unit {unit}: failed: nothing was sent, or nothing came");
    #[cfg(feature = "defmt")]
    ::defmt::debug!(
        "unit {=u8}: failed: nothing was sent, or nothing came",
        unit
    );
    let _ = unit;
}

/// An identifier, if there is one, and bytes, with a space before each.
#[cfg(feature = "log")]
struct Shown<'a>(Option<u32>, &'a [u8]);

#[cfg(feature = "log")]
impl core::fmt::Display for Shown<'_> {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        if let Some(id) = self.0 {
            write!(formatter, " {id:X}h")?;
        }
        self.1
            .iter()
            .try_for_each(|byte| write!(formatter, " {byte:02X}"))
    }
}
