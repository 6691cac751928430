// SPDX-License-Identifier: 0BSD
//! The macro that makes a point of its facts.

/// A point of a device: its type, and what its access allows, of the facts that a generated file holds.
///
/// The facts stand in this order; those in brackets are there where a point has them:
///
/// - its attributes, its type, `[of Device]`, the type of its raw number, its name in the description \[and its code\];
/// - the space and the (lowest) address, `[from "base"]`: what it counts from, `[selects Page 1]`: what other points
///   must hold before the address means this one, `[written_with ["other"]]`: what one request writes together with
///   the point, `[addresses [...]]` in reading order, `[words 2]`,
///   `[width 24]`: the bits of a number narrower than its type, `[low_byte_first true]` of each word,
///   `[coded true]`: a [coding](crate::coding) of its own,
///   `[write_at 0x2028]`: where it is written, if that is elsewhere, `[index 1]`,
///   `[telegram "name"]`, `[bits 4 0x00F0 group]`: shift, mask, `group` or `signed_group`, `[fixed 0x8000 0x8000]`:
///   the bits of the word that are always the same, and what they are;
/// - `[const NUMBERING: u32 = 1;]`: what other numberings call it;
/// - `[unit "Hz"]`, `[decimals 1]` of counts, `[display 2]`: with how many decimals people see the value,
///   `[epoch 0]`: from when it counts seconds, `[raw 30..=4000]`: the least and the greatest raw number;
/// - `=>` what decoding gives (`value`, a `reading` beside special codes, or either `_or_error`), its type, and the
///   [form](crate::form) with its own facts;
/// - `[codes ...]`: the special codes, or where they are;
/// - `[read { ... }]` and `[write { ... }]`: the type of counts, what is needed from other points, what may be written,
///   and the function if it is not the usual one;
/// - `[impl ... { ... }]`: what else it can do on its bus.
///
/// ```
/// use fieldscribe_runtime::{point, CountReadable, Encodable, Point, Readable};
///
/// point! {
///     /// Base frequency.
///     #[doc(alias = "A003")]
///     BaseFrequency: u16 = "base_frequency", "A003";
///     at Holding 0x1019;
///     unit "Hz";
///     decimals 1;
///     raw 300..=4000;
///     => value f64 as scaled(10, 1);
///     read { count i32; }
///     write { count i32; }
/// }
///
/// assert_eq!(BaseFrequency::UNIT, "Hz");
/// assert_eq!(BaseFrequency::decode(500), 50.0);
/// assert_eq!(BaseFrequency::decode_count(500), 500);
/// assert_eq!(BaseFrequency::encode(50.0), Ok(500));
/// let error = BaseFrequency::encode(29.0).unwrap_err();
/// assert_eq!(error.to_string(), "base_frequency: 29 Hz is outside 30 to 400 Hz (raw 300 to 4000)");
/// ```
#[macro_export]
macro_rules! point {
    (
        $(#[$attribute:meta])*
        $name:ident $(of $device:ty)?: $raw:ty = $item:literal $(, $code:literal)?;
        at $space:ident $(($other:literal))? $address:literal $(from $base:literal)?;
        $(selects $($selecting:ident $held:literal),+;)?
        $(written_with $together:tt;)?
        $(addresses $addresses:tt;)?
        $(words $words:literal;)?
        $(width $width:literal;)?
        $(low_byte_first $low_byte_first:literal;)?
        $(coded $coded:literal;)?
        $(write_at $write_address:literal;)?
        $(index $index:literal;)?
        $(telegram $telegram:literal;)?
        $(bits $shift:literal $mask:literal $extract:ident;)?
        $(fixed $fixed_mask:literal $fixed_bits:literal;)?
        $(const $numbering:ident: $number_type:ty = $number:literal;)*
        $(unit $unit:literal;)?
        $(decimals $decimals:literal;)?
        $(display $display:literal;)?
        $(epoch $epoch:literal;)?
        $(raw $low:literal..=$high:literal;)?
        => $kind:ident $value:ty as $form:ident $facts:tt;
        $(codes $codes:tt;)?
        $(read $read:tt)?
        $(write $write:tt)?
        $(impl $trait:path { $($member:tt)* })*
    ) => {
        $(#[$attribute])*
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl $crate::Point for $name {
            type Device = $crate::point!(@first $($device,)? $crate::AnyDevice,);
            type Raw = $raw;
            type Value = $crate::point!(@meaning $kind $value, $raw);
            const NAME: &'static str = $item;
            $(const CODE: Option<&'static str> = Some($code);)?
            const SPACE: $crate::Space = $crate::Space::$space$(($other))?;
            const ADDRESS: u16 = $address;
            $(const BASE: &'static str = $base;)?
            $(const SELECTS: &'static [$crate::Selection] = &[$($crate::Selection::of::<$selecting>($held)),+];)?
            $(const WRITTEN_WITH: &'static [&'static str] = &$together;)?
            $(const ADDRESSES: &'static [u16] = &$addresses;)?
            $(const WORDS: u16 = $words;)?
            $(const WIDTH: u32 = $width;)?
            $(const LOW_BYTE_FIRST: bool = $low_byte_first;)?
            $(const CODED: bool = $coded;)?
            $(const WRITE_ADDRESS: u16 = $write_address;)?
            $(const INDEX: Option<u8> = Some($index);)?
            $(const TELEGRAM: Option<&'static str> = Some($telegram);)?
            $(const FIXED_MASK: u32 = $fixed_mask; const FIXED_BITS: u32 = $fixed_bits;)?
            const FLOATING: bool = $crate::point!(@floating $form);
            $(const UNIT: &'static str = $unit;)?
            $(const DECIMALS: u32 = $decimals;)?
            $(const DISPLAY_DECIMALS: Option<u32> = Some($display);)?
            $(const EPOCH: Option<i64> = Some($epoch);)?
            $(const RAW_MIN: $raw = $low; const RAW_MAX: $raw = $high;)?
            const ACCESS: $crate::Access = $crate::point!(@access $(r $read)? $(w $write)?);
            const FACTS: &'static $crate::data::PointFacts = &$crate::data::PointFacts::of::<Self>()
                .formed($crate::point!(@data $form $value))
                $(.within($low as i128, $high as i128))?
                $(.coded($crate::point!(@coded $codes)))?
                $(.reading($crate::point!(@reading $read)))?
                $(.writing($crate::point!(@writing $form $write)))?;
            $(
                const GROUP: Option<u16> = Some($mask);

                #[inline]
                fn from_words([word]: [u16; 1]) -> $raw {
                    let bits = $crate::Raw::from_words([$crate::$extract::<Self>(word)]);
                    $crate::coding::decoded::<Self>(bits)
                }
            )?
        }

        $crate::point!(@placed $name $($shift $mask)?);
        $crate::point!(@alone $name $($together)?);
        $crate::point!(@form $form $name $kind ($($low $high)?) $facts);
        $($crate::point!(@codes $name $raw, $codes);)?
        $($crate::point!(@display $name $raw, $kind $form $display);)?
        $($crate::point!(@read $name $raw, $kind $form $read);)?
        $($crate::point!(@write $name $raw, $kind $form $write);)?
        $(impl $trait for $name { $($member)* })*
        $crate::point!(@numberings $name $($numbering $number_type, $number;)*);
    };

    (@data named $value:ty) => { $crate::data::Form::Named(<$value>::NAMES) };
    (@data scaled $value:ty) => { $crate::data::Form::Scaled($crate::data::DataScale::of::<Self>()) };
    (@data wide $value:ty) => { $crate::point!(@data scaled $value) };
    (@data ruled $value:ty) => { $crate::data::Form::Ruled($crate::data::ruled::<Self>) };
    (@data floating $value:ty) => { $crate::data::Form::Floating };
    (@data text $value:ty) => { $crate::data::Form::Text };
    (@data packed $value:ty) => { $crate::data::Form::Text };
    (@data dated $value:ty) => { $crate::data::Form::Text };
    (@data unicode $value:ty) => { $crate::data::Form::Text };
    (@data $form:ident $value:ty) => { $crate::data::Form::Plain };

    (@coded $codes:tt) => { &<Self as $crate::Coded>::CODES };

    (@reading { $(count $count:ty;)? $(with $factors:ty;)? }) => {
        $crate::data::others::<$crate::point!(@first $($factors,)? (),), Self>()
    };

    (@writing $form:ident {
        $(count $count:ty;)?
        $(with $with:ty;)?
        $(closed $closed:literal;)?
        $(in [$($first:literal $(..=$last:literal)?)|+];)?
        $(ranges $ranges:tt;)?
        $(limits |$others:ident| $limits:tt;)?
        $(check $check:path;)?
        $(function $function:literal;)?
        $(values $values:tt;)?
    }) => {
        $crate::data::Writing {
            ranges: &[$($(($first as i128, $crate::point!(@last $first $($last)?))),+)?],
            is_closed: $crate::point!(@any $($closed)?),
            needs: <$crate::point!(@first $($with,)? (),) as $crate::data::Needs>::points,
            check: $crate::point!(@checking $form $($limits)?),
            encode: $crate::point!(@encoding $form $($values)?),
            function: $crate::point!(@some $($function)?),
        }
    };

    (@last $first:literal) => { $first as i128 };
    (@last $first:literal $last:literal) => { $last as i128 };
    (@any) => { false };
    (@any $closed:literal) => { $closed };
    (@some) => { None };
    (@some $function:literal) => { Some($function) };
    (@checking floating) => { Some($crate::data::checked::<Self>) };
    (@checking digits) => { Some($crate::data::checked::<Self>) };
    (@checking $form:ident) => { None };
    (@checking $form:ident $limits:tt) => { Some($crate::data::checked::<Self>) };
    (@encoding ruled) => { Some($crate::data::encoded::<Self>) };
    (@encoding floating) => { Some($crate::data::encoded::<Self>) };
    (@encoding $form:ident $($values:tt)?) => { None };

    (@meaning value $value:ty, $raw:ty) => { $value };
    (@meaning value_or_error $value:ty, $raw:ty) => { $value };
    (@meaning $kind:ident $value:ty, $raw:ty) => { $crate::Reading<$value, $raw> };

    (@output value $value:ident) => { $value };
    (@output reading $value:ident) => { $value };
    (@output $kind:ident $value:ident) => { Result<$value, $crate::Error> };

    (@decoded reading $raw:ident $value:expr) => { $crate::reading::<Self, _>($raw, |$raw| $value) };
    (@decoded reading_or_error $raw:ident $value:expr) => { $crate::try_reading::<Self, _>($raw, |$raw| $value) };
    (@decoded $kind:ident $raw:ident $value:expr) => { $value };

    (@encoded reading $value:ident $raw:expr) => { $crate::encoded::<Self, _>($value, |$value| $raw) };
    (@encoded reading_or_error $value:ident $raw:expr) => { $crate::encoded::<Self, _>($value, |$value| $raw) };
    (@encoded $kind:ident $value:ident $raw:expr) => { $raw };

    (@no $given:tt) => { false };
    (@first $first:ty, $($other:ty,)?) => { $first };

    (@access) => { $crate::Access::None };
    (@access r $read:tt) => { $crate::Access::Read };
    (@access w $write:tt) => { $crate::Access::Write };
    (@access r $read:tt w $write:tt) => { $crate::Access::ReadWrite };

    (@floating floating) => { true };
    (@floating $form:ident) => { false };

    (@placed $name:ident) => {
        impl $crate::Whole for $name {}
    };
    (@placed $name:ident $shift:literal $mask:literal) => {
        impl $crate::BitGroup for $name {
            const SHIFT: u32 = $shift;
            const MASK: u16 = $mask;
        }
    };

    (@alone $name:ident) => {
        impl $crate::WrittenAlone for $name {}
    };
    (@alone $name:ident $together:tt) => {};

    (@numberings $name:ident) => {};
    (@numberings $name:ident $($numbering:ident $type:ty, $number:literal;)+) => {
        impl $name {
            $(
                #[doc = concat!("The number in the numbering `", stringify!($numbering), "`.")]
                pub const $numbering: $type = $number;
            )+
        }
    };

    (@form named $name:ident $kind:ident $reach:tt ($carried:ty)) => {
        impl $crate::Named for $name {
            type Carried = $carried;
        }
    };
    (@form digits $name:ident $kind:ident $reach:tt ($carried:ty, $numbers:expr)) => {
        impl $crate::Named for $name {
            type Carried = $carried;
        }

        impl $crate::Digits for $name {
            const NUMBERS: &'static [u16] = &$numbers;
        }
    };
    (@form scaled $name:ident $kind:ident $reach:tt (
        $num:literal, $den:literal $(, $offset:literal, $over:literal)?
    )) => {
        impl $crate::FixedScale for $name {
            const SCALE: $crate::Scale = $crate::Scale::new($num, $den)$(.plus($offset, $over))?;
            $crate::point!(@reach $kind $reach);
        }
    };
    (@form wide $name:ident $kind:ident $reach:tt $facts:tt) => {
        $crate::point!(@form scaled $name $kind $reach $facts);
    };
    (@form ruled $name:ident $kind:ident $reach:tt (
        |$with:ident: $factors:ty| $rule:expr $(; wide $wide:tt)? $(; within [$($within:tt)+])?
    )) => {
        impl $crate::Scaled for $name {
            type Factors = $factors;
            $(const IS_WIDE: bool = $wide;)?
            $(
                #[inline]
                fn is_beyond(raw: Self::Raw) -> bool {
                    !matches!(raw, $($within)+)
                }
            )?

            #[inline]
            fn rule($with: Self::Factors) -> Result<$crate::Rule, $crate::Error> {
                $rule
            }
        }
    };
    (@form packed $name:ident $kind:ident $reach:tt ($($layout:literal),+)) => {
        impl $crate::form::packed::Packed for $name {
            const LAYOUT: $crate::text::Layout = $crate::text::Layout::new($($layout),+);
        }
    };
    (@form unicode $name:ident $kind:ident $reach:tt ($bits:literal, $($layout:literal),+)) => {
        $crate::point!(@form packed $name $kind $reach ($($layout),+));

        impl $crate::form::unicode::Unicode for $name {
            const BITS: u32 = $bits;
        }
    };
    (@form dated $name:ident $kind:ident $reach:tt (
        $bcd:literal, $low_first:literal, [$($field:ident $word:literal $low:literal $mask:literal $base:literal),+]
    )) => {
        impl $crate::form::dated::Dated for $name {
            const FORM: $crate::date_time::DateForm = $crate::date_time::DateForm::new(
                $bcd,
                $low_first,
                &[$($crate::date_time::DatePart($crate::date_time::DateField::$field, $word, $low, $mask, $base)),+],
            );
        }
    };
    (@form $form:ident $name:ident $kind:ident $reach:tt ()) => {};

    (@display $name:ident $raw:ty, $kind:ident ruled $display:literal) => {
        $crate::point!(@displayed $name $raw, $kind ruled <Self as $crate::Scaled>::Factors);
    };
    (@display $name:ident $raw:ty, $kind:ident $form:ident $display:literal) => {
        $crate::point!(@displayed $name $raw, $kind $form ());
    };
    (@displayed $name:ident $raw:ty, $kind:ident $form:ident $needs:ty) => {
        impl $crate::Displayed for $name {
            type Needs = $needs;

            fn told_with(raw: $raw, with: Self::Needs) -> Result<$crate::Shown, $crate::Error> {
                $crate::point!(@told $kind raw);
                $crate::form::$form::shown::<Self>(raw, with)
            }
        }
    };
    (@told reading $raw:ident) => {
        if let Some(special) = <Self as $crate::Coded>::special($raw) {
            return Ok($crate::Shown::code(special.name()));
        }
    };
    (@told reading_or_error $raw:ident) => { $crate::point!(@told reading $raw); };
    (@told $kind:ident $raw:ident) => {};

    (@reach value ($low:literal $high:literal)) => { const RAW_REACH: (i128, i128) = ($low, $high); };
    (@reach value_or_error ($low:literal $high:literal)) => { const RAW_REACH: (i128, i128) = ($low, $high); };
    (@reach $kind:ident $reach:tt) => {};

    (@codes $name:ident $raw:ty, ($all:path)) => {
        impl $crate::Coded for $name {
            const CODES: &'static [$crate::Code<$raw>] = $all;
        }
    };
    (@codes $name:ident $raw:ty, {
        $(
            $(#[$attribute:meta])*
            $special:ident $($last:ident)? = $made:ident($text:literal, $low:literal $(..=$high:literal)?);
        )+
    }) => {
        impl $crate::Coded for $name {
            const CODES: &'static [$crate::Code<$raw>] = &[
                $($crate::point!(@code Self::$special $(, Self::$last)?)),+
            ];
        }

        impl $name {
            $(
                $(#[$attribute])*
                pub const $special: $crate::Special<$raw> = $crate::Special::$made($text, $low);
                $(
                    #[doc = concat!("The last raw number of `", $text, "`.")]
                    pub const $last: $raw = $high;
                )?
            )+
        }
    };
    (@code $one:expr) => { $crate::Code::one($one) };
    (@code $first:expr, $last:expr) => { $crate::Code::band($first, $last) };

    (@read $name:ident $raw:ty, $kind:ident $form:ident {
        $(count $count:ty;)?
        $(with $factors:ty;)?
    }) => {
        impl $crate::Readable for $name {
            type Factors = $crate::point!(@first $($factors,)? (),);
            type Output<V> = $crate::point!(@output $kind V);

            #[inline]
            fn decode_with(raw: $raw, with: Self::Factors) -> Self::Output<Self::Value> {
                $crate::point!(@decoded $kind raw $crate::form::$form::decode::<Self, _>(raw, with))
            }
        }

        $(
            impl $crate::CountReadable for $name {
                type Count = $crate::point!(@meaning $kind $count, $raw);

                #[inline]
                fn decode_count_with(raw: $raw, with: Self::Factors) -> Self::Output<Self::Count> {
                    $crate::point!(@decoded $kind raw $crate::form::$form::decode_count::<Self, _>(raw, with))
                }
            }
        )?
    };

    (@write $name:ident $raw:ty, $kind:ident $form:ident {
        $(count $count:ty;)?
        $(with $with:ty;)?
        $(closed $closed:literal;)?
        $(in $allowed:tt;)?
        $(ranges $ranges:tt;)?
        $(limits |$others:ident| $limits:tt;)?
        $(check $check:path;)?
        $(function $function:literal;)?
        $(values $values:tt;)?
    }) => {
        impl $crate::Writable for $name {
            type With = $crate::point!(@first $($with,)? (),);
            $(const WRITE_FUNCTION: Option<u8> = Some($function);)?
            $(const IS_CLOSED: bool = $closed;)?
            $(const IS_CONTIGUOUS: bool = $crate::point!(@no $allowed);)?
            $(const IS_CONTIGUOUS: bool = $ranges.len() == 1;)?
            $(const IS_CONTIGUOUS: bool = $crate::point!(@no $limits);)?

            #[inline]
            fn check_with(raw: $raw, with: Self::With) -> Result<(), $crate::Error> {
                $crate::point!(@special $kind raw);
                $crate::point!(@check $form raw with
                    $(in $allowed)? $(ranges $ranges)? $(limits $others $limits)? $(check $check)?)
            }
        }

        $crate::point!(@encode $name $raw, $kind $form $($values)?);

        $(
            impl $crate::CountWritable for $name {
                type Count = $crate::point!(@meaning $kind $count, $raw);

                #[inline]
                fn encode_count_with(count: Self::Count, with: Self::With) -> Result<$raw, $crate::Error> {
                    $crate::point!(@encoded $kind count $crate::form::$form::encode_count::<Self, _>(count, with))
                }
            }
        )?
    };

    (@special reading $raw:ident) => {
        if let Some(special) = <Self as $crate::Coded>::special($raw) {
            return special.checked::<Self>();
        }
    };
    (@special reading_or_error $raw:ident) => { $crate::point!(@special reading $raw); };
    (@special $kind:ident $raw:ident) => {};

    (@check $form:ident $raw:ident $with:ident) => {{
        let _ = $with;
        $crate::form::$form::check::<Self>($raw)
    }};
    (@check $form:ident $raw:ident $with:ident in [$($allowed:tt)+]) => {{
        let _ = $with;
        $crate::check::listed::<Self>($raw, matches!($raw, $($allowed)+))
    }};
    (@check $form:ident $raw:ident $with:ident ranges $ranges:tt) => {{
        let _ = $with;
        $crate::form::$form::ranged::<Self>($raw, &$ranges)
    }};
    (@check $form:ident $raw:ident $with:ident limits $others:ident $limits:tt) => {{
        let $others = $with;
        let limits = (|| Ok($limits))();
        $crate::check::limited::<Self>($raw, &limits.map_err($crate::Error::of::<Self>)?)
    }};
    (@check $form:ident $raw:ident $with:ident check $check:path) => {{
        let _ = $with;
        $check($raw)
    }};

    (@encode $name:ident $raw:ty, $kind:ident $form:ident none) => {};
    (@encode $name:ident $raw:ty, $kind:ident $form:ident) => {
        impl $crate::Encodable for $name {
            #[inline]
            fn encode_with(value: Self::Value, with: Self::With) -> Result<$raw, $crate::Error> {
                $crate::point!(@encoded $kind value $crate::form::$form::encode::<Self, _>(value, with))
            }
        }
    };
}

/// Functions by which clients read what a point needs of others, for a struct of raw numbers in the module `with`.
#[macro_export]
macro_rules! read_by_clients {
    ([$($parameter:ident: $bound:path)?] $name:ident: $($field:ident $point:ident)+) => {
        impl $name {
            $crate::read_by_clients!(
                @with "Reads the raw numbers by a client that blocks.", read [] []
                Client Transport [$($parameter: $bound)?] $($field $point)+
            );
            $crate::read_by_clients!(
                @with "As `read`, by a client that does not block.", read_async [async] [.await]
                AsyncClient AsyncTransport [$($parameter: $bound)?] $($field $point)+
            );
            $crate::read_by_clients!(
                @with "As `read`, by a client of one thread.", read_local [async] [.await]
                LocalClient LocalTransport [$($parameter: $bound)?] $($field $point)+
            );
        }

        $crate::needed_points!($name: $($field $point)+);
    };
    (@got [] $raw:expr) => { $raw? };
    (@got [.await] $raw:expr) => { $raw.await? };
    (
        @with $about:literal, $read:ident [$($async:ident)?] $wait:tt
        $client:ident $transport:ident [$($parameter:ident: $bound:path)?] $($field:ident $point:ident)+
    ) => {
        #[doc = $about]
        ///
        /// # Errors
        /// Whatever the client's error tells.
        pub $($async)? fn $read<T: super::$transport $(, $parameter: $bound)?>(
            client: &mut super::$client<T $(, $parameter)?>,
        ) -> Result<Self, super::ClientError<T::Error>> {
            Ok(Self {
                $($field: $crate::read_by_clients!(@got $wait client.read_raw::<super::points::$point>()),)+
            })
        }
    };
}

/// The points whose raw numbers a struct in the module `with` holds.
#[macro_export]
macro_rules! needed_points {
    ($name:ident: $($field:ident $point:ident)+) => {
        impl $crate::data::Needs for $name {
            fn points() -> &'static [&'static $crate::data::PointFacts] {
                const { &[$(<super::points::$point as $crate::Point>::FACTS),+] }
            }

            fn from_raws(raws: &[i128]) -> Option<Self> {
                let mut raws = raws.iter();
                Some(Self { $($field: $crate::Raw::from_i128(*raws.next()?)?,)+ })
            }
        }
    };
}
