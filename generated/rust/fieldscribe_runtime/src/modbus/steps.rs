// SPDX-License-Identifier: 0BSD
//! Commands of several requests in order: a set-up, a key with its complement, a mailbox.

/// A command of several requests. Its documentation says what each step does, and when it is left out.
///
/// ```
/// use fieldscribe_runtime::modbus::{Request, SteppedCommand};
///
/// const CLOSE_BREAKER: SteppedCommand = fieldscribe_runtime::stepped! {
///     "close_breaker" "unit" 1 32;
///     None, Some(16), 0x1008, 0, false, "": 0 1 0xFFFF 0, 2 0 0xFFFF 0, 0xFFFF 0xFFFF 0xFFFF 0;
/// };
/// assert!(CLOSE_BREAKER.takes(&[3]));
/// for step in CLOSE_BREAKER.steps {
///     let mut words = [0; 3]; // what `step.read` brings, where there is such a function
///     step.fill(&[3], &mut words);
///     assert_eq!(words, [3, 2, 65532]);
///     if let Some(function) = step.write {
///         let request = Request::write_values(1, function, step.address, &words);
///         let _ = request.counted_from(step.base); // which `client.set_base` says
///     }
/// }
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SteppedCommand {
    /// The name.
    pub name: &'static str,
    /// The name, the least and the greatest number of each argument.
    pub arguments: &'static [(&'static str, i32, i32)],
    /// The steps in order.
    pub steps: &'static [Step],
}

/// One request: it writes words, or reads them until they are as they should be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    /// The function that reads the words before: to wait for them, or for the bits that stay.
    pub read: Option<u8>,
    /// The function that writes them; none for a step that waits.
    pub write: Option<u8>,
    /// The address of the first.
    pub address: u16,
    /// The words.
    pub words: &'static [StepWord],
    /// The most milliseconds to wait.
    pub within: u32,
    /// Whether the step is left out unless the condition in the documentation holds.
    pub is_conditional: bool,
    /// The name of the base that the address counts from; empty if that is 0.
    pub base: &'static str,
}

/// A word: constant + factor * argument, modulo 65536, in the bits of `mask`; the others stay.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StepWord {
    /// What is always added.
    pub constant: u16,
    /// What the argument is multiplied by.
    pub factor: u16,
    /// The bits that the step is about.
    pub mask: u16,
    /// Which argument.
    pub argument: u8,
}

impl SteppedCommand {
    /// Whether these are all arguments, and what they may be.
    #[must_use]
    pub fn takes(&self, arguments: &[i32]) -> bool {
        let mut pairs = self.arguments.iter().zip(arguments);
        arguments.len() == self.arguments.len()
            && pairs.all(|(&(_, low, high), number)| (low..=high).contains(number))
    }
}

impl Step {
    /// Puts the words of the step in place of those that were read, or of anything if nothing is; whether that changed
    /// none of them, which is what a step without `write` waits for.
    pub fn fill(&self, arguments: &[i32], words: &mut [u16]) -> bool {
        let mut same = true;
        for (word, held) in self.words.iter().zip(words) {
            let filled = *held & !word.mask | word.number(arguments) & word.mask;
            same &= filled == *held;
            *held = filled;
        }
        same
    }
}

impl StepWord {
    fn number(self, arguments: &[i32]) -> u16 {
        let argument = arguments.get(usize::from(self.argument)).copied();
        let bits = argument.unwrap_or(0).rem_euclid(0x1_0000);
        let product = self.factor.wrapping_mul(u16::try_from(bits).unwrap_or(0));
        self.constant.wrapping_add(product)
    }
}

/// A command from the rows of its steps.
#[macro_export]
#[doc(hidden)]
macro_rules! stepped {
    ($name:literal $($argument:literal $low:literal $high:literal),*;
     $($read:expr, $write:expr, $address:literal, $within:literal, $conditional:literal, $base:literal:
       $($constant:literal $factor:literal $mask:literal $at:literal),*;)*) => {
        $crate::modbus::SteppedCommand {
            name: $name,
            arguments: &[$(($argument, $low, $high)),*],
            steps: &[$($crate::modbus::Step {
                read: $read,
                write: $write,
                address: $address,
                within: $within,
                is_conditional: $conditional,
                base: $base,
                words: &[$($crate::modbus::StepWord {
                    constant: $constant,
                    factor: $factor,
                    mask: $mask,
                    argument: $at,
                }),*],
            }),*],
        }
    };
}
