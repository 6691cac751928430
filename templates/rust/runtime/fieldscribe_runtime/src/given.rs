// SPDX-License-Identifier: 0BSD
//! The text that an error repeats.

use core::fmt;

/// The text that was given to a point, or its start.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Given {
    start: [u8; 30],
    length: u8,
    is_cut: bool,
}

impl Given {
    /// As much of a text as an error keeps.
    pub(crate) fn new(text: &str) -> Self {
        let mut start = [0; 30];
        let mut end = text.len().min(start.len());
        while !text.is_char_boundary(end) {
            end = end.saturating_sub(1);
        }
        for (place, byte) in start.iter_mut().zip(text.bytes().take(end)) {
            *place = byte;
        }
        let (length, is_cut) = (u8::try_from(end).unwrap_or(0), end < text.len());
        Self {
            start,
            length,
            is_cut,
        }
    }
}

impl fmt::Debug for Given {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let start = self.start.get(..usize::from(self.length));
        let text = core::str::from_utf8(start.unwrap_or_default()).unwrap_or_default();
        let rest = if self.is_cut { "..." } else { "" };
        write!(formatter, "{text:?}{rest}")
    }
}
