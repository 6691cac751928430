// error: E0308
// says: expected `PointInfo<SampleDrive>`, found `PointInfo<Trips>`
// Nor does it take a point of another device as data.

use sample_drive::{Client, Transport};

pub fn wrong<T: Transport>(client: &mut Client<T>, point: trips::PointInfo) {
    let _ = client.write_point(point, 5);
}
