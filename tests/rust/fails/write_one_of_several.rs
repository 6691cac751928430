// error: E0277
// says: `ClockHour::WRITTEN_WITH` names the others
// What the device takes only with other points, in one request, is not written alone.

use kitchen_sink::{points::ClockHour, Client, Transport};

pub fn wrong<T: Transport>(client: &mut Client<T>) {
    let _ = client.write::<ClockHour>(7);
}
