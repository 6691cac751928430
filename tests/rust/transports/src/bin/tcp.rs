//! TCP of the standard library: a real server in both framings, and one that does what servers should not.

use std::io::{ErrorKind, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::thread::{sleep, spawn};
use std::time::{Duration, Instant};

use hitachi_l200::enums::RunCommand;
use hitachi_l200::runtime::modbus::{framing_of, Function, Profile, Request};
use hitachi_l200::runtime::About;
use hitachi_l200::runtime::transports::tcp::TcpLine;
use hitachi_l200::{blocks, points as p, Client, ClientError, Framing, ReplyError, PROFILE};

static GATEWAY: Profile = PROFILE.with_framings(&[Framing::Tcp]);
const QUICK: Duration = Duration::from_millis(250);

fn talks(port: &str, profile: &'static Profile, framing: Framing) {
    let mut client = Client::new(TcpLine::new(format!("127.0.0.1:{port}")), framing, 1).with_profile(profile);
    assert_eq!(client.read::<p::OutputFrequency>().unwrap(), 0.7);
    client.write::<p::BaseFrequency>(50.0).unwrap();
    assert_eq!(client.read_count::<p::BaseFrequency>().unwrap(), 500);
    client.write::<p::AccelerationTime>(12.34).unwrap();
    assert_eq!(client.read::<p::AccelerationTime>().unwrap(), 12.34);
    client.write::<p::RunCommand>(RunCommand::Run).unwrap();
    assert_eq!(client.read::<p::RunCommand>().unwrap(), RunCommand::Run);
    assert!(blocks::MONITOR_D.iter().all(|block| client.read_block(block).is_ok()));
    let refused = client.exchange(Request::new(1, 3, 0x2000, 1)).unwrap_err();
    assert!(matches!(refused, ClientError::Reply(ReplyError::Exception { code: 2, .. }, Some(_))), "{refused}");
    assert_eq!(client.read::<p::BaseFrequency>().unwrap(), 50.0);
}

/// A server that treats each request as its script says, with the connection's and the request's number.
fn serve(script: fn(usize, usize, &[u8], &mut TcpStream) -> bool) -> Client<TcpLine<String>> {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = listener.local_addr().unwrap().to_string();
    spawn(move || {
        for (connection, stream) in listener.incoming().enumerate() {
            let mut stream = stream.unwrap();
            spawn(move || {
                let mut request = [0; 260];
                for number in 0.. {
                    match stream.read(&mut request) {
                        Ok(length @ 1..) if script(connection, number, &request[..length], &mut stream) => {}
                        _ => break,
                    }
                }
            });
        }
    });
    Client::new(TcpLine::new(address).timeout(QUICK), Framing::Tcp, 1).with_profile(&GATEWAY)
}

/// The answer to a request of one word.
fn word(request: &[u8], word: u8) -> Vec<u8> {
    [&request[..4], &[0, 5, 1, 3, 2, 0, word]].concat()
}

fn kind(error: &ClientError<std::io::Error>) -> Option<ErrorKind> {
    match error {
        ClientError::Transport(error, Some(About::Point("output_frequency"))) => Some(error.kind()),
        _ => None,
    }
}

fn a_lost_connection_is_made_anew() {
    let mut client = serve(|connection, number, request, stream| match (connection, number) {
        (0, _) => false,
        (1, 1) => stream.write_all(&word(request, 8)).is_err(), // and closes
        _ => stream.write_all(&word(request, 7)).is_ok(),
    });
    let lost = client.read::<p::OutputFrequency>().unwrap_err();
    assert_eq!(kind(&lost), Some(ErrorKind::UnexpectedEof), "{lost}");
    assert_eq!(lost.to_string(), "output_frequency: the other side closed the connection");
    assert_eq!(client.read::<p::OutputFrequency>().unwrap(), 0.7);
    assert_eq!(client.read::<p::OutputFrequency>().unwrap(), 0.8);
    sleep(QUICK);
    assert_eq!(client.read::<p::OutputFrequency>().unwrap(), 0.7); // closed meanwhile, and nobody noticed
}

fn errors_say_where_nobody_listens() {
    let nobody = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap();
    for (address, text) in [
        (nobody.to_string(), format!("output_frequency: {nobody}: Connection refused")),
        ("127.0.0.1".into(), "output_frequency: invalid socket address: it is a name or a number with a port".into()),
    ] {
        let told = Client::new(TcpLine::new(address), Framing::Rtu, 1).read::<p::OutputFrequency>().unwrap_err();
        assert!(told.to_string().starts_with(&text), "{told}");
    }
}

fn a_late_answer_answers_nothing() {
    let mut client = serve(|connection, _, request, stream| {
        if connection == 0 {
            sleep(2 * QUICK);
        }
        stream.write_all(&word(request, 9)).is_ok()
    });
    let started = Instant::now();
    let late = client.read::<p::OutputFrequency>().unwrap_err();
    assert_eq!(kind(&late), Some(ErrorKind::TimedOut), "{late}");
    assert_eq!(late.to_string(), "output_frequency: no byte came");
    assert!(started.elapsed() >= QUICK);
    assert_eq!(client.read::<p::OutputFrequency>().unwrap(), 0.9);
}

fn an_answer_that_drips_is_late_as_a_whole() {
    let mut client = serve(|_, _, request, stream| {
        word(request, 1).iter().all(|byte| {
            sleep(QUICK / 4);
            stream.write_all(&[*byte]).is_ok()
        })
    });
    let cut = client.read::<p::OutputFrequency>();
    assert!(matches!(cut, Err(ClientError::Reply(ReplyError::ShortFrame { received: 1..=4, .. }, _))), "{cut:?}");
    assert_eq!(client.received(), &[0, 1, 0, 0, 0, 5][..client.received().len()]);
}

fn another_transaction_is_passed_over() {
    let mut client = serve(|_, _, request, stream| {
        let mut other = word(request, 3);
        other[1] ^= 0x55;
        stream.write_all(&[other, word(request, 4)].concat()).is_ok()
    });
    assert_eq!(client.read::<p::OutputFrequency>().unwrap(), 0.4);
    assert_eq!(client.read::<p::OutputFrequency>().unwrap(), 0.4);
}

fn what_is_no_reply_ends_the_connection() {
    let mut client = serve(|connection, _, request, stream| match connection {
        0 => stream.write_all(&[0xFF; 300]).is_ok(),
        _ => stream.write_all(&word(request, 5)).is_ok(),
    });
    let noise = client.read::<p::OutputFrequency>().unwrap_err();
    assert!(matches!(noise, ClientError::Reply(..)), "{noise}");
    assert_eq!(client.read::<p::OutputFrequency>().unwrap(), 0.5);
}

/// A server that never stops sending keeps nobody: its connection is given up within the time of an answer.
fn noise_without_end_ends_the_connection() {
    let mut client = serve(|connection, number, request, stream| {
        let answered = stream.write_all(&word(request, 6)).is_ok();
        if (connection, number) == (0, 0) {
            while stream.write_all(&[0x55; 65536]).is_ok() {}
        }
        answered
    });
    assert_eq!(client.read::<p::OutputFrequency>().unwrap(), 0.6);
    sleep(QUICK);
    let started = Instant::now();
    assert_eq!(client.read::<p::OutputFrequency>().unwrap(), 0.6);
    assert!(started.elapsed() < QUICK);
}

/// No request of RTU looks like one over TCP, and none over TCP like one of RTU.
fn the_framing_shows() {
    static ALL: &[Function] = &[
        Function::new(1, 2000), Function::new(2, 2000), Function::new(3, 125), Function::new(4, 125),
        Function::new(5, 1), Function::new(6, 1), Function::new(8, 1), Function::new(15, 1968), Function::new(16, 123),
    ];
    static PLAIN: Profile = Profile::new(ALL, &[Framing::Rtu, Framing::Tcp], (0, 255), None);
    static PADS: Profile = PLAIN.padding_coils();
    let mut frame = [0; 300];
    for (function, profile) in ALL.iter().flat_map(|function| [(function, &PLAIN), (function, &PADS)]) {
        for count in 1..=function.most {
            let values = vec![u16::from(function.number == 5); usize::from(count)];
            let request = match function.number {
                1..=4 => Request::new(0, function.number, 0, count),
                _ => Request::write_values(0, function.number, 0, &values),
            };
            for (framing, request) in [(Framing::Rtu, request), (Framing::Tcp, request.tcp(0))] {
                let Ok(length) = request.build(profile, &mut frame) else { continue };
                assert_eq!(framing_of(&frame[..length]), framing, "{function:?} {count}");
            }
        }
    }
}

fn main() {
    let ports: Vec<String> = std::env::args().skip(1).collect();
    talks(&ports[0], &PROFILE, Framing::Rtu);
    talks(&ports[1], &GATEWAY, Framing::Tcp);
    a_lost_connection_is_made_anew();
    errors_say_where_nobody_listens();
    a_late_answer_answers_nothing();
    an_answer_that_drips_is_late_as_a_whole();
    another_transaction_is_passed_over();
    what_is_no_reply_ends_the_connection();
    noise_without_end_ends_the_connection();
    the_framing_shows();
}
