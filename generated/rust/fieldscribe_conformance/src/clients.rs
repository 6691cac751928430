// SPDX-License-Identifier: 0BSD
//! What clients of all families do with points, by vectors of their exchanges.

use fieldscribe_runtime::ClientError;

use super::{same, Script, Vector};

/// That an exchange came out as the vector says, and sent what it should.
pub fn exchanged<T>(
    vector: &Vector,
    found: Result<T, ClientError<()>>,
    script: &Script,
) -> Result<Option<T>, String> {
    let (status, found) = match found {
        Ok(found) => ("ok", Some(found)),
        Err(ClientError::Transport(..)) => ("timeout", None),
        Err(error) => (error.name(), None),
    };
    same(vector.text("status").as_str(), status)?;
    script.done()?;
    Ok(found)
}

/// The same operation with the client that blocks and the one that does not, each over a script of its own.
macro_rules! both {
    ($vector:ident, $profile:ident, $base:expr, |$client:ident| $call:expr) => {{
        let found = blocked($vector, $profile, $base, &|$client| $call)?;
        let mut client = waiting($vector, $profile, $base);
        let $client = &mut client;
        let again = crate::now($call);
        let again = crate::clients::exchanged($vector, again, client.into_transport().as_ref())?;
        same(true, found == again)?;
        found
    }};
}

/// What the clients of a family do with points of the trait `$reach`; they write those of `$alone`.
///
/// The family's module has `blocking` and `waiting`, the two clients over the script of a vector. Each point is tried
/// with the client that blocks; the module of the family's clients shows that the other one has the same methods.
macro_rules! with_clients {
    ($line:ty, $reach:path, $alone:path) => {
        /// What the client that blocks does with the script of the vector.
        fn blocked<T>(
            vector: &Vector,
            profile: &'static Profile,
            base: &'static str,
            call: &dyn Fn(&mut Client<$line>) -> Result<T, ClientError<()>>,
        ) -> Result<Option<T>, String> {
            let mut client = blocking(vector, profile, base);
            let found = call(&mut client);
            crate::clients::exchanged(vector, found, client.into_transport().as_ref())
        }

        /// A point's raw number.
        pub fn read<P>(vector: &Vector, profile: &'static Profile) -> Outcome
        where
            P: Readable<Raw: Number> + $reach,
        {
            let found = blocked(vector, profile, P::BASE, &|client| {
                client.read_raw::<P>().map(Number::to_number)
            })?;
            same(vector.number("raw"), found)?;
            read_data(vector, profile, P::INFO.any())
        }

        /// A text's words.
        pub fn read_text<P>(vector: &Vector, profile: &'static Profile) -> Outcome
        where
            P: Readable + Whole + $reach,
        {
            let found = blocked(vector, profile, P::BASE, &|client| {
                client
                    .read_raw::<P>()
                    .map(|raw| P::to_words(raw).as_ref().to_vec())
            })?;
            same(vector.numbers("words"), found.unwrap_or_default())
        }

        /// The same by the data of a point that needs no others.
        fn read_data(vector: &Vector, profile: &'static Profile, point: PointInfo) -> Outcome {
            if let Some(value) = crate::data_of(vector, point) {
                let found = both!(vector, profile, point.base, |client| client
                    .read_point(point));
                same(Some(value), found)?;
            }
            Ok(())
        }

        fn write_data(vector: &Vector, profile: &'static Profile, point: PointInfo) -> Outcome {
            if let Some(value) = crate::written_data_of(vector, point) {
                both!(vector, profile, point.base, |client| client
                    .write_point(point, value));
            }
            Ok(())
        }

        /// The value of a raw number is written.
        pub fn write<P>(
            vector: &Vector,
            profile: &'static Profile,
            factors: P::Factors,
            with: P::With,
        ) -> Outcome
        where
            P: Readable<Raw: Number, Value: Copy> + Encodable<With: Copy> + Whole + $alone,
        {
            let value = P::decode_with(vector.raw("raw"), factors)
                .into_result()
                .map_err(Error::name)?;
            blocked(vector, profile, P::BASE, &|client| {
                client.write_with::<P>(value, with)
            })?;
            write_data(vector, profile, P::INFO.any())
        }

        /// A text is written.
        pub fn write_text<P>(vector: &Vector, profile: &'static Profile) -> Outcome
        where
            P: Readable<Factors = (), Value: Copy> + Encodable<With = ()> + Whole + $alone,
        {
            let words: Vec<u16> = vector.numbers("words");
            let raw = P::from_received(words.into_iter()).map_err(Error::name)?;
            let value = P::decode(raw).into_result().map_err(Error::name)?;
            blocked(vector, profile, P::BASE, &|client| client.write::<P>(value))?;
            Ok(())
        }

        /// A group of bits is written into its word.
        pub fn update<P>(vector: &Vector, profile: &'static Profile) -> Outcome
        where
            P: Readable<Raw: Number, Factors = (), Value: Copy>
                + Encodable<With = ()>
                + BitGroup
                + $alone,
        {
            update_with::<P>(vector, profile, (), ())
        }

        /// The same for a group that needs other points.
        pub fn update_with<P>(
            vector: &Vector,
            profile: &'static Profile,
            factors: P::Factors,
            with: P::With,
        ) -> Outcome
        where
            P: Readable<Raw: Number, Value: Copy> + Encodable<With: Copy> + BitGroup + $alone,
        {
            let value = P::decode_with(vector.raw("raw"), factors)
                .into_result()
                .map_err(Error::name)?;
            blocked(vector, profile, P::BASE, &|client| {
                client.update_with::<P>(value, with)
            })?;
            write_data(vector, profile, P::INFO.any())
        }
    };
}
