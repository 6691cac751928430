//! What the Rust programs of tests/fuzz share: they read cases from standard input and print one line for each.

use std::io::{Read, Write};

/// All cases, and how far they are read.
pub struct Cases {
    bytes: Vec<u8>,
    at: usize,
}

impl Cases {
    /// The cases on standard input.
    pub fn read() -> Self {
        let mut bytes = Vec::new();
        std::io::stdin().read_to_end(&mut bytes).expect("cases");
        Self { bytes, at: 0 }
    }

    /// Whether there are more.
    pub fn more(&self) -> bool {
        self.at < self.bytes.len()
    }

    /// The next bytes.
    pub fn bytes(&mut self, count: usize) -> Vec<u8> {
        self.at += count;
        self.bytes[self.at - count..self.at].to_vec()
    }

    /// The next byte.
    pub fn byte(&mut self) -> u8 {
        self.bytes(1)[0]
    }

    /// The next little-endian word.
    pub fn word(&mut self) -> u16 {
        u16::from(self.byte()) | u16::from(self.byte()) << 8
    }

    /// The next frame: its length and its bytes.
    pub fn frame(&mut self) -> Vec<u8> {
        let length = self.word();
        self.bytes(usize::from(length))
    }
}

/// Prints a line of words.
pub fn say(out: &mut impl Write, words: &[String]) {
    writeln!(out, "{}", words.join(" ")).expect("standard output");
}
