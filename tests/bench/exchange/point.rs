//! Reads a point of the L200 as a count and writes it, and keeps why that failed. Without `both` it does nothing.
#![no_std]
#![no_main]

use core::hint::black_box;
use core::panic::PanicInfo;

use hitachi_l200::{points as p, Client, Framing, Transport};

struct Line;

impl Transport for Line {
    type Error = ();

    fn exchange(&mut self, request: &[u8], reply: &mut [u8]) -> Result<usize, ()> {
        black_box(reply);
        match black_box(request).len() {
            0 => Err(()),
            length => Ok(length),
        }
    }
}

#[panic_handler]
fn never(_: &PanicInfo<'_>) -> ! {
    loop {}
}

#[no_mangle]
pub extern "C" fn _start() {
    if cfg!(feature = "both") {
        let mut drive = Client::new(Line, Framing::Rtu, 1);
        let found = drive.read_count::<p::BaseFrequency>();
        if let Ok(count) = black_box(found) {
            let done = drive.write_count::<p::BaseFrequency>(count + 10);
            let _ = black_box(done);
        }
    }
}
