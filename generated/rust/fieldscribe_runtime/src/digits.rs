// SPDX-License-Identifier: 0BSD
//! Words whose decimal digits each mean something.

use crate::check::{saturated, unknown};
use crate::{Digits, Error};

/// The decimal digits of `raw`, the highest first; the first takes what the others leave.
#[must_use]
pub fn split<const N: usize>(raw: u16) -> [u16; N] {
    let mut digits = [0; N];
    let mut rest = raw;
    for digit in digits.iter_mut().skip(1).rev() {
        *digit = rest % 10;
        rest /= 10;
    }
    if let Some(first) = digits.first_mut() {
        *first = rest;
    }
    digits
}

/// The number of these digits, if each is one of the point's numbers.
///
/// # Errors
/// [`Error::UnknownValue`] if one is not, or if a word cannot hold the number.
pub fn join<P: Digits>(digits: &[impl Into<i128> + Copy]) -> Result<u16, Error> {
    digits.iter().try_fold(0_u16, |number, digit| {
        let wide: i128 = (*digit).into();
        let digit = u16::try_from(wide).ok();
        let listed = digit.filter(|digit| P::NUMBERS.contains(digit));
        let joined = listed.and_then(|digit| number.checked_mul(10)?.checked_add(digit));
        joined.ok_or_else(|| unknown::<P>(saturated(wide)))
    })
}

/// Whether each of the `N` digits of `raw` is one of the point's numbers.
///
/// # Errors
/// [`Error::UnknownValue`] if one is not.
pub fn check<P: Digits, const N: usize>(raw: u16) -> Result<(), Error> {
    let digits = split::<N>(raw);
    if digits.iter().all(|digit| P::NUMBERS.contains(digit)) {
        Ok(())
    } else {
        Err(unknown::<P>(raw.into()))
    }
}
