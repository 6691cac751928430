// SPDX-License-Identifier: 0BSD
//! Points whose scale needs the raw numbers of other points.

pub use crate::check::within as check;
use crate::check::{beyond, saturated};
use crate::display;
use crate::form::{checked, in_counts, nearest, per_unit};
use crate::{Error, Raw, Rule, Scaled, Shown, Writable};

/// The value: the binary64 number nearest to the exact one.
///
/// # Errors
/// Those of the rule; [`Error::Overflow`].
#[inline]
pub fn decode<P: Scaled, V: From<f64>>(raw: P::Raw, with: P::Factors) -> Result<V, Error> {
    let rule = holding::<P>(raw, with)?;
    let value = if P::IS_WIDE {
        rule.decode_wide(raw.to_i128())
    } else {
        rule.decode(raw.to_i64())
    };
    value.map(V::from).map_err(Error::of::<P>)
}

/// The count nearest to the value, rounded half away from zero.
///
/// # Errors
/// Those of the rule; [`Error::Overflow`].
#[inline]
pub fn decode_count<P: Scaled, C: From<i64>>(raw: P::Raw, with: P::Factors) -> Result<C, Error> {
    let rule = holding::<P>(raw, with)?;
    let count = rule.decode_count(raw.to_i64(), per_unit(P::DECIMALS));
    count.map(C::from).map_err(Error::of::<P>)
}

/// The value as people see it, rounded from the exact one.
///
/// # Errors
/// Those of the rule; [`Error::Overflow`].
pub fn shown<P: Scaled>(raw: P::Raw, with: P::Factors) -> Result<Shown, Error> {
    let rule = holding::<P>(raw, with)?;
    let count = rule.shown_count(raw.to_i64(), display::per_unit::<P>());
    let count = count.map_err(Error::of::<P>)?;
    Ok(Shown::count::<P>(count.into()))
}

/// The rule that holds now, if the raw number is not too large for it.
#[inline]
fn holding<P: Scaled>(raw: P::Raw, with: P::Factors) -> Result<Rule, Error> {
    let rule = P::rule(with).map_err(Error::of::<P>)?;
    if P::is_beyond(raw) {
        return Err(Error::Overflow(Some(P::NAME)));
    }
    Ok(rule)
}

/// The raw number nearest to a value, checked; each step is rounded to binary64.
///
/// # Errors
/// Those of the rule and of [`Writable::check_with`]; [`Error::NotANumber`].
#[inline]
pub fn encode<P, V: Into<f64>>(value: V, with: P::With) -> Result<P::Raw, Error>
where
    P: Scaled + Writable<With: Into<P::Factors>>,
{
    let value = value.into();
    if value.is_nan() {
        return Err(Error::NotANumber(P::NAME));
    }
    let rule = P::rule(with.into()).map_err(Error::of::<P>)?;
    let decode = |raw| rule.decode(saturated(raw)).unwrap_or(f64::NAN);
    nearest::<P>(value, rule.encode(value), with, decode)
}

/// The raw number nearest to a count, halves away from zero, checked.
///
/// # Errors
/// Those of the rule and of [`Writable::check_with`].
#[inline]
pub fn encode_count<P, C: Into<i64>>(count: C, with: P::With) -> Result<P::Raw, Error>
where
    P: Scaled + Writable<With: Into<P::Factors>>,
{
    let rule = P::rule(with.into()).map_err(Error::of::<P>)?;
    let count = count.into();
    let decode = |raw| rule.decode_count(raw, per_unit(P::DECIMALS)).ok();
    let number = rule.encode_count(count, per_unit(P::DECIMALS));
    let number = number.map_or(i128::MAX, i128::from);
    let raw = P::Raw::from_i128(number).ok_or_else(|| beyond::<P>(number));
    raw.and_then(|raw| checked::<P>(raw, with))
        .map_err(|error| in_counts(error, count, decode))
}
