// error: E0277
// says: `client.update::<P>(value)` reads the word
// A group of bits is not written as if the word were its own.

use fieldscribe_runtime::modbus::Request;
use sample_drive::points::DelayClass;

pub fn wrong() -> Request<'static> {
    Request::write::<DelayClass>(1, 3)
}
