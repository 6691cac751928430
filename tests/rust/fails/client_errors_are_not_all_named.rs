// error: E0004
// Errors may come to be told apart further, in every family.

use fieldscribe_runtime::ClientError;

pub fn wrong<E>(error: ClientError<E>) -> bool {
    match error {
        ClientError::Point(_) | ClientError::Build(..) | ClientError::Reply(..) => true,
        ClientError::Transport(..) => false,
    }
}
