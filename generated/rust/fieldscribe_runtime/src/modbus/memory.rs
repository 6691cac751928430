// SPDX-License-Identifier: 0BSD
//! What a client remembers of what it selected.

use crate::Selection;

/// What a client remembers of the selection that it wrote last.
///
/// A selection stands as long as each further request read a point or wrote one that it selects. So a failure ends it,
/// and so does whatever is asked without a point.
pub trait Memory: Sized + Send {
    /// Nothing is selected.
    const NOTHING: Self;

    /// What stands when the last request was this transaction.
    #[must_use]
    fn standing(&self, _transaction: u16) -> &'static [Selection] {
        &[]
    }

    /// That this stands after a transaction.
    fn keep(&mut self, _transaction: u16, _selected: &'static [Selection]) {}
}

/// Nothing: for devices without pages, and those that are chosen at run time.
#[derive(Debug)]
pub struct Forgets;

impl Memory for Forgets {
    const NOTHING: Self = Self;
}

/// The last selection: the clients of devices with pages have it.
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
