// SPDX-License-Identifier: 0BSD
//! The macro that makes an enum of named numbers.

/// Numbers with names: an enum with a variant for each, and one for all other numbers.
///
/// Two of them are equal if their numbers are.
///
/// ```
/// use fieldscribe_runtime::named_numbers;
///
/// named_numbers! {
///     /// Run source.
///     RunSource: u16, else Unknown;
///     /// Terminal.
///     Terminal = 1 "terminal";
///     /// Modbus.
///     Modbus = 3 "modbus";
/// }
///
/// assert_eq!(RunSource::from(3), RunSource::Modbus);
/// assert_eq!(u16::from(RunSource::Modbus), 3);
/// assert_eq!(RunSource::Unknown(3), RunSource::Modbus);
/// assert_eq!(RunSource::Unknown(3).name(), Some("modbus"));
/// assert_eq!((RunSource::Unknown(9).name(), RunSource::Unknown(9).to_string()), (None, "9".into()));
/// ```
#[macro_export]
macro_rules! named_numbers {
    (
        $(#[$attribute:meta])*
        $name:ident: $raw:ty, else $unknown:ident;
        $($(#[$documented:meta])* $entry:ident = $number:literal $text:literal;)*
    ) => {
        $(#[$attribute])*
        #[derive(Clone, Copy, Debug)]
        pub enum $name {
            $($(#[$documented])* $entry,)*
            /// A number without a name here.
            $unknown($raw),
        }

        impl $name {
            /// All numbers that have names.
            pub const NAMES: &'static [(i128, &'static str)] = &[$(($number, $text)),*];

            /// The name in the description, if the number has one.
            #[must_use]
            pub const fn name(self) -> Option<&'static str> {
                match self {
                    $(Self::$entry | Self::$unknown($number) => Some($text),)*
                    Self::$unknown(_) => None,
                }
            }
        }

        impl ::core::fmt::Display for $name {
            fn fmt(&self, formatter: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
                match self.name() {
                    Some(name) => formatter.pad(name),
                    None => ::core::fmt::Display::fmt(&<$raw>::from(*self), formatter),
                }
            }
        }

        impl From<$raw> for $name {
            #[inline]
            fn from(raw: $raw) -> Self {
                match raw {
                    $($number => Self::$entry,)*
                    _ => Self::$unknown(raw),
                }
            }
        }

        impl From<$name> for $raw {
            #[inline]
            fn from(value: $name) -> Self {
                match value {
                    $($name::$entry => $number,)*
                    $name::$unknown(raw) => raw,
                }
            }
        }

        impl PartialEq for $name {
            #[inline]
            fn eq(&self, other: &Self) -> bool {
                <$raw>::from(*self) == <$raw>::from(*other)
            }
        }

        impl Eq for $name {}

        impl ::core::hash::Hash for $name {
            fn hash<H: ::core::hash::Hasher>(&self, state: &mut H) {
                ::core::hash::Hash::hash(&<$raw>::from(*self), state);
            }
        }
    };
}
