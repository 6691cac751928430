// SPDX-License-Identifier: 0BSD
//! What errors of requests, of replies and of clients say, whatever the bus.

#![allow(clippy::too_many_lines, reason = "a line for each case")]

use fieldscribe_runtime::{About, BuildError, ClientError, Error, ReplyError};

use super::runtime::{chain, tells, Lost, FAILED, FAILURE, REFUSED};

made_up!(Word u16, Holding 0x10, &[0x10], 1);
made_up!(Long u32, Holding 0x20, &[0x20, 0x21], 2);

/// Panics where the runtime is not as it should be.
pub fn check() {
    requests();
    replies();
    clients();
    lost();
}

fn requests() {
    tells(
        BuildError::name,
        &[
            (
                BuildError::BadFraming,
                "bad_framing",
                "the device does not speak this framing; behind a gateway that does, use `with_framings`",
            ),
            (
                BuildError::NotForAll,
                "bad_unit",
                "this cannot be sent to all units",
            ),
            (
                BuildError::BadUnit,
                "bad_unit",
                "the device has no such unit number",
            ),
            (
                BuildError::BadFunction,
                "bad_function",
                "the device does not know the function",
            ),
            (
                BuildError::BadCount,
                "bad_count",
                "the device does not take that many items",
            ),
            (
                BuildError::BadAddress,
                "bad_address",
                "the items end beyond the last address",
            ),
            (
                BuildError::NoBase,
                "bad_base",
                "nobody said where the base is that the address counts from: use `set_base` or `find`",
            ),
            (
                BuildError::BadBit,
                "bad_value",
                "a bit is neither 0 nor 1",
            ),
            (
                BuildError::BufferTooSmall,
                "buffer_too_small",
                "the buffer is too small",
            ),
            (
                BuildError::NoBroadcast,
                "bad_link",
                "the device takes nothing that is sent to all units",
            ),
            (
                BuildError::OtherUnit,
                "bad_unit",
                "the request is to another unit than the client's",
            ),
            (
                BuildError::BadLink,
                "bad_link",
                "the telegram does not fit the link",
            ),
            (
                BuildError::BadTask,
                "bad_task",
                "the device does not know the task, or the link carries none",
            ),
            (
                BuildError::BadParameter,
                "bad_parameter",
                "the parameter number is above 31999",
            ),
            (BuildError::BadIndex, "bad_index", "the index is above 255"),
            (
                BuildError::NoRoom,
                "bad_value",
                "the parameter part has no room for a double word",
            ),
            (
                BuildError::BadMask,
                "bad_mask",
                "the first word is meant without the bits that make it valid",
            ),
            (
                BuildError::NoMessage,
                "no_message",
                "the device has no message for this",
            ),
        ],
    );
}

fn replies() {
    tells(
        ReplyError::name,
        &[
            (
                ReplyError::BadFunction,
                "bad_function",
                "the function is none of Modbus",
            ),
            (
                ReplyError::ShortFrame {
                    expected: 7,
                    received: 3,
                },
                "short_frame",
                "3 bytes came instead of 7",
            ),
            (
                ReplyError::LongFrame {
                    expected: 7,
                    received: 9,
                },
                "long_frame",
                "9 bytes came instead of 7",
            ),
            (ReplyError::BadCrc, "bad_crc", "the checksum is wrong"),
            (
                ReplyError::BadProtocol,
                "bad_protocol",
                "the protocol number is not 0",
            ),
            (
                ReplyError::WrongTransaction {
                    expected: 7,
                    received: 8,
                },
                "wrong_transaction",
                "the reply is to transaction 8 instead of 7",
            ),
            (
                ReplyError::WrongUnit {
                    expected: 5,
                    received: 4,
                },
                "wrong_unit",
                "unit 4 replied instead of 5",
            ),
            (
                ReplyError::WrongFunction {
                    expected: 3,
                    received: 16,
                },
                "wrong_function",
                "the reply is to function 10h instead of 03h",
            ),
            (
                ReplyError::Exception {
                    code: 0x21,
                    name: Some("value_out_of_range"),
                },
                "exception",
                "the device refused with exception 21h (value_out_of_range)",
            ),
            (
                ReplyError::Exception {
                    code: 2,
                    name: None,
                },
                "exception",
                "the device refused with exception 02h (illegal_data_address)",
            ),
            (
                ReplyError::Exception {
                    code: 0x0B,
                    name: None,
                },
                "exception",
                "the device refused with exception 0Bh (gateway_target_device_failed_to_respond)",
            ),
            (
                ReplyError::BadByteCount {
                    expected: 6,
                    received: 4,
                },
                "bad_byte_count",
                "the reply has 4 data bytes instead of 6",
            ),
            (
                ReplyError::EchoMismatch {
                    expected: (0x1028, 500),
                    received: (0x1029, 10),
                },
                "echo_mismatch",
                "01F4h was written to 1028h, the reply repeats 000Ah at 1029h",
            ),
            (
                ReplyError::WrongStart,
                "wrong_start",
                "the reply does not begin with 02h",
            ),
            (
                ReplyError::WrongLength,
                "wrong_length",
                "the reply does not fit the link: is that of the drive set so?",
            ),
            (
                ReplyError::WrongCheck,
                "wrong_check",
                "the check byte is wrong",
            ),
            (
                ReplyError::WrongParameter,
                "wrong_parameter",
                "the answer is about another parameter",
            ),
            (
                ReplyError::NoAnswer,
                "no_answer",
                "the device did not answer what was asked",
            ),
            (
                ReplyError::Refused {
                    error: 17,
                    name: Some("not_now"),
                },
                "refused",
                "the drive refused with error 17 (not_now)",
            ),
            (
                ReplyError::Refused {
                    error: 3,
                    name: None,
                },
                "refused",
                "the drive refused with error 3",
            ),
            (
                ReplyError::NoRights,
                "no_rights",
                "the drive gives no right to change parameters",
            ),
            (
                ReplyError::WrongResponse {
                    task: 1,
                    response: 3,
                },
                "wrong_response",
                "response 3 does not belong to task 1",
            ),
            (
                ReplyError::OtherNumber {
                    written: 8,
                    answered: Some(0x10007),
                },
                "echo_mismatch",
                "8 was written, the device answered 65543",
            ),
            (
                ReplyError::OtherNumber {
                    written: 8,
                    answered: None,
                },
                "echo_mismatch",
                "8 was written, the device answered nothing",
            ),
            (
                ReplyError::OtherFloat {
                    written: 60.0_f32.to_bits(),
                    answered: 59.5_f32.to_bits(),
                },
                "echo_mismatch",
                "60 was written, the device answered 59.5",
            ),
        ],
    );
}

fn clients() {
    let errors: [(ClientError<Lost>, &str, &str); 4] = [
        (
            Error::Overflow(None).into(),
            "overflow",
            "the result does not fit its type",
        ),
        (
            BuildError::BadUnit.into(),
            "bad_unit",
            "the device has no such unit number",
        ),
        (
            ReplyError::BadCrc.into(),
            "bad_crc",
            "the checksum is wrong",
        ),
        (ClientError::Transport(Lost, None), "line", "nothing came"),
    ];
    let request = About::Request {
        unit: 5,
        function: 3,
        address: 0x10,
        count: 2,
    };
    for (error, name, shown) in errors {
        assert_eq!((error.name(), error.point()), (name, None));
        assert_eq!(chain(&error), [shown]);
        let about = error.of::<Word>();
        assert_eq!((about.name(), about.point()), (name, Some("Word")));
        assert_eq!(chain(&about), [format!("Word: {shown}")]);
        assert_eq!(about.of::<Long>(), about);
    }
    let block: ClientError<Lost> = ClientError::Reply(ReplyError::BadCrc, Some(request));
    assert_eq!(block.point(), None);
    let text = "unit 5, function 3 at 0010h, 2 items: the checksum is wrong";
    assert_eq!(block.to_string(), text);
    assert_eq!(block.of::<Word>().point(), Some("Word"));
    let other: ClientError<Lost> = ClientError::Point(REFUSED);
    assert_eq!(other.of::<Long>(), other);
    assert_eq!(other.point(), REFUSED.point());
    assert_eq!(chain(&ClientError::Transport(FAILED, None)), FAILURE);
}

/// Trying again helps where a frame was lost or spoiled, and nowhere else.
fn lost() {
    let is_lost = |error: ReplyError| {
        assert_eq!(ClientError::<Lost>::from(error).is_lost(), error.is_lost());
        error.is_lost()
    };
    let exception = |code, name| is_lost(ReplyError::Exception { code, name });
    assert_eq!([2, 4, 6].map(|code| exception(code, None)), [false; 3]);
    assert_eq!([0x0A, 0x0B].map(|code| exception(code, None)), [true; 2]);
    assert!(!exception(0x0A, Some("of_the_device")));
    assert!([
        ReplyError::BadCrc,
        ReplyError::NoAnswer,
        ReplyError::WrongStart,
        ReplyError::WrongCheck,
        ReplyError::WrongLength,
        ReplyError::ShortFrame {
            expected: 7,
            received: 3
        },
        ReplyError::WrongUnit {
            expected: 5,
            received: 4
        },
    ]
    .map(is_lost)
    .iter()
    .all(|lost| *lost));
    let (expected, received) = ((1, 2), (1, 3));
    let (written, answered) = (8, Some(7));
    let (error, name) = (17, None);
    for error in [
        ReplyError::EchoMismatch { expected, received },
        ReplyError::OtherNumber { written, answered },
        ReplyError::OtherFloat {
            written,
            answered: 7,
        },
        ReplyError::Refused { error, name },
        ReplyError::NoRights,
        ReplyError::BadFunction,
    ] {
        assert!(!is_lost(error));
    }
    let others: [ClientError<Lost>; 3] = [
        ClientError::Transport(Lost, None),
        BuildError::BadUnit.into(),
        REFUSED.into(),
    ];
    assert_eq!(others.map(|error| error.is_lost()), [true, false, false]);
}
