// SPDX-License-Identifier: 0BSD
//! The selection that a client remembers.

use crate::Selection;

/// Remembers the selection that a client wrote last.
///
/// A selection is valid as long as each further request reads a point, or writes one that it selects. A failure ends
/// it, and so does any request without a point.
pub trait Memory: Sized + Send {
    /// Nothing is selected.
    const NOTHING: Self;

    /// The current selection, if the last request was this transaction.
    #[must_use]
    fn standing(&self, _transaction: u16) -> &'static [Selection] {
        &[]
    }

    /// Records the selection after a transaction.
    fn keep(&mut self, _transaction: u16, _selected: &'static [Selection]) {}
}

/// No memory: for devices without pages, and those that are chosen at run time.
#[derive(Debug)]
pub struct Forgets;

impl Memory for Forgets {
    const NOTHING: Self = Self;
}

/// The last selection, for clients of devices with pages.
#[derive(Debug)]
pub struct Remembers(Option<(u16, &'static [Selection])>);

impl Memory for Remembers {
    const NOTHING: Self = Self(None);

    fn standing(&self, transaction: u16) -> &'static [Selection] {
        match self.0 {
            Some((last, selected)) if last == transaction => selected,
            _ => &[],
        }
    }

    fn keep(&mut self, transaction: u16, selected: &'static [Selection]) {
        self.0 = Some((transaction, selected));
    }
}
