//! A logger that keeps what the drivers tell.

use std::sync::Mutex;

use log::{set_logger, set_max_level, LevelFilter, Log, Metadata, Record};

struct Kept(Mutex<Vec<String>>);

impl Log for Kept {
    fn enabled(&self, about: &Metadata<'_>) -> bool {
        about.target() == "fieldscribe"
    }

    fn log(&self, record: &Record<'_>) {
        if self.enabled(record.metadata()) {
            self.0.lock().unwrap().push(record.args().to_string());
        }
    }

    fn flush(&self) {}
}

static KEPT: Kept = Kept(Mutex::new(Vec::new()));

/// Keeps messages from now on.
pub fn keep() {
    set_logger(&KEPT).unwrap();
    set_max_level(LevelFilter::Debug);
}

/// The messages so far.
#[must_use]
pub fn kept() -> Vec<String> {
    KEPT.0.lock().unwrap().clone()
}
