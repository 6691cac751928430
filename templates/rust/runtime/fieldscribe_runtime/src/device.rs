// SPDX-License-Identifier: 0BSD
//! Devices as types: the points of one device do not compile with the client of another.

/// A device: a type that its points and its client name.
///
/// ```compile_fail,E0277
/// use fieldscribe_runtime::modbus::{Client, Framing, Function, Profile};
/// use fieldscribe_runtime::{point, Device, Transport};
///
/// #[derive(Clone, Copy, Debug)]
/// pub struct Drive;
///
/// impl Device for Drive {
///     type Profile = Profile;
///     const NAME: &'static str = "drive";
///     const PROFILE: &'static Profile = &Profile::new(&[Function::new(3, 4)], &[Framing::Rtu], (1, 32), None);
/// }
///
/// #[derive(Clone, Copy, Debug)]
/// pub struct Meter;
///
/// point! {
///     /// Energy.
///     Energy of Meter: u16 = "energy";
///     at Holding 0x1028;
///     => value u16 as plain();
///     read {}
/// }
///
/// fn wrong<T: Transport>(line: T) {
///     let mut client = Client::<T, Drive>::new(line, Framing::Rtu, 1);
///     let _ = client.read::<Energy>(); // a point of `Meter` is no point of `Drive`
/// }
/// ```
pub trait Device {
    /// What the frames of its bus need to know of it.
    type Profile: 'static;
    /// The device's name in its description.
    const NAME: &'static str;
    /// What the frames need to know of this device.
    const PROFILE: &'static Self::Profile;
}

/// Any device: the device of a client that gets its profile at run time.
///
/// Its client takes points of every device, so nothing but the caller's care keeps them apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct AnyDevice;

/// A device whose client takes the points, blocks and commands of the device `D`: of its own, or of any device.
#[diagnostic::on_unimplemented(
    message = "a point of the device `{D}` is no point of the device `{Self}`",
    label = "of `{D}`, in a client of `{Self}`",
    note = "a client whose device is chosen at run time is made by `for_profile`"
)]
pub trait Accepts<D> {}

impl<D: Device> Accepts<D> for D {}

impl<D> Accepts<D> for AnyDevice {}
