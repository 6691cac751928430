// error: E0308
// says: expected `&Block<SampleDrive>`, found `&Block<Trips>`
// Nor does it take the blocks of another device, or give its commands.

use sample_drive::{Client, Transport};

pub fn wrong<T: Transport>(client: &mut Client<T>, block: &trips::Block) {
    let _ = client.read_block(block);
}
