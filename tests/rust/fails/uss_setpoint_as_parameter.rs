// error: E0277
// says: is no parameter, but a point of the process data
// Process data are no parameter.

use fieldscribe_runtime::uss::Request;
use odd_uss::points::MainSetpoint;

pub fn wrong() -> Request {
    Request::write::<MainSetpoint>(1, 0x2000)
}
