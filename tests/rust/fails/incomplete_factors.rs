// error: E0063
// All raw numbers that a point needs have to be given.

use sample_drive::with;

pub fn wrong() -> with::Setpoint {
    with::Setpoint { unit_mode: 0 }
}
