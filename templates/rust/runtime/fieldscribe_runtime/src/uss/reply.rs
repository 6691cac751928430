// SPDX-License-Identifier: 0BSD
//! Answers out of telegrams.

use super::request::is_sound;
use super::{element, Link, Profile, Request, Value, START};
use crate::{Error, Point, Raw, ReplyError};

/// What a drive answered: a response with a value, and words of process data.
#[derive(Clone, Copy, Debug)]
pub struct Reply<'a> {
    response: u8,
    value: Value,
    words: &'a [u8],
}

impl Reply<'_> {
    /// The number of the response; 0 if there is none.
    #[must_use]
    pub const fn response(&self) -> u8 {
        self.response
    }

    /// The value; nothing if there was no task.
    #[must_use]
    pub const fn value(&self) -> Value {
        self.value
    }

    /// The words of process data.
    pub fn words(&self) -> impl Iterator<Item = u16> + '_ {
        words(self.words)
    }

    /// The value as one word.
    ///
    /// # Errors
    /// [`Error::WrongLength`] if it is none.
    pub const fn word(&self) -> Result<u16, Error> {
        match self.value {
            Value::Word(word) => Ok(word),
            _ => Err(Error::WrongLength(None)),
        }
    }

    /// The value as the raw number of a point.
    ///
    /// # Errors
    /// [`Error::WrongLength`] if the point has another number of words.
    pub fn raw<P: Point>(&self) -> Result<P::Raw, Error> {
        let mut found = P::Raw::MIN.into_words();
        let filled = self.value.fill(found.as_mut());
        filled.map_err(Error::of::<P>)?;
        Ok(crate::point::joined::<P>(found))
    }
}

impl Request {
    /// Parses bytes as the answer to this request. Bytes of any content and length are safe.
    ///
    /// # Errors
    /// Why the bytes are no answer to this request, or the refusal of the drive.
    pub fn parse<'b>(
        &self,
        profile: &Profile,
        link: Link,
        bytes: &'b [u8],
    ) -> Result<Reply<'b>, ReplyError> {
        let (part, process) = self.unwrap(link, bytes)?;
        let mut reply = Reply {
            response: 0,
            value: Value::Nothing,
            words: process,
        };
        if link.pkw == 0 {
            return Ok(reply);
        }
        let mut part = words(part);
        let mut next = || part.next().ok_or(ReplyError::WrongLength);
        let (number, index, first, second) = (next()?, next()?, next()?, next());
        let [high, _] = number.to_be_bytes();
        reply.response = high >> 4;
        if self.task == 0 {
            return Ok(reply);
        }
        if reply.response == 0 {
            return Err(ReplyError::NoAnswer);
        }
        if [number & 0x0FFF, index] != element(self.parameter, self.index) {
            return Err(ReplyError::WrongParameter);
        }
        match reply.response {
            7 => return Err(profile.refusal(first)),
            8 => return Err(ReplyError::NoRights),
            response if !profile.answers(self.task, response) => {
                return Err(ReplyError::WrongResponse {
                    task: self.task,
                    response,
                });
            }
            2 | 5 => reply.value = Value::Double(u32::from(first) << 16 | u32::from(second?)),
            _ if link.single_last() => reply.value = Value::Word(second?),
            _ => reply.value = Value::Word(first),
        }
        Ok(reply)
    }

    /// The words of process data in an answer, which are there too when the drive refuses the task.
    ///
    /// # Errors
    /// Why the bytes are no answer of the unit over this link.
    pub fn process_words<'b>(
        &self,
        link: Link,
        bytes: &'b [u8],
    ) -> Result<impl Iterator<Item = u16> + 'b, ReplyError> {
        let (_, process) = self.unwrap(link, bytes)?;
        Ok(words(process))
    }

    /// The parameter part and the process data of a telegram that fits the link.
    fn unwrap<'b>(&self, link: Link, bytes: &'b [u8]) -> Result<(&'b [u8], &'b [u8]), ReplyError> {
        if bytes.first() != Some(&START) {
            return Err(ReplyError::WrongStart);
        }
        let &[_, length, unit, ref data @ .., _] = bytes else {
            return Err(ReplyError::WrongLength);
        };
        let whole = usize::from(length).checked_add(2) == Some(bytes.len()) && data.len() % 2 == 0;
        let process = usize::from(link.pzd) * 2;
        let split = data.len().checked_sub(process).filter(|_| whole);
        let parts = split.and_then(|split| data.split_at_checked(split));
        let (part, process) = parts.ok_or(ReplyError::WrongLength)?;
        if !link.takes(part.len() / 2) {
            return Err(ReplyError::WrongLength);
        }
        if !is_sound(bytes) {
            return Err(ReplyError::WrongCheck);
        }
        if unit != self.unit {
            let (expected, received) = (self.unit, unit);
            return Err(ReplyError::WrongUnit { expected, received });
        }
        Ok((part, process))
    }
}

fn words(bytes: &[u8]) -> impl Iterator<Item = u16> + '_ {
    bytes.chunks(2).map(|pair| {
        pair.iter()
            .fold(0, |word: u16, byte| word << 8 | u16::from(*byte))
    })
}
