// error: E0277
// says: is not written: the device does not take it
// A point that the device does not take has no request that writes it.

use fieldscribe_runtime::modbus::Request;
use sample_drive::points::Running;

pub fn wrong() -> Request<'static> {
    Request::write::<Running>(1, true)
}
