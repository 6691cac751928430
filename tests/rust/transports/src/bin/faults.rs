//! Replies that are broken, cut, late, doubled, foreign or missing, at each byte, over each line: the error comes in
//! time, the next request has its reply, and the log has the frames.

use std::collections::VecDeque;
use std::io::{ErrorKind, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::{scope, sleep, spawn};
use std::time::{Duration, Instant};

use hitachi_l200::runtime::modbus::{crc, framing_of, Framing, Profile};
use hitachi_l200::runtime::transports::{embedded_io, stream::StreamLine, tcp::TcpLine, tokio_modbus, LineError, Protocol};
use hitachi_l200::{points as p, AsyncClient, Client, ClientError, Transport, PROFILE};
use tokio::runtime::Builder;

static GATEWAY: Profile = PROFILE.with_framings(&[Framing::Tcp, Framing::Rtu]);
/// The timeouts in milliseconds: a line that fails at one is tried at the next, for a machine may do other work.
const TIMEOUTS: [u64; 2] = [60, 600];
static TIMEOUT: AtomicU64 = AtomicU64::new(0);
const MOST: Duration = Duration::from_secs(4);

fn timeout() -> Duration {
    Duration::from_millis(TIMEOUT.load(Ordering::Relaxed))
}

type Fault = fn(&[u8], usize) -> Vec<u8>;
const AT_EACH_BYTE: [Fault; 4] = [
    |reply, at| [&reply[..at], &[reply[at] ^ 0xFF], &reply[at + 1..]].concat(),
    |reply, at| reply[..at].to_vec(),
    |reply, at| [&reply[..at], &reply[at + 1..]].concat(),
    |reply, at| [&reply[..=at], &reply[at..]].concat(),
];

/// What comes of a request.
#[derive(Clone)]
enum Answer {
    Spoiled(Fault, usize),
    Late,
    Doubled,
    Repeated,
    Foreign,
    BehindForeign,
    JoinedToForeign,
    InPieces,
    Noise,
    TooMuch,
}

/// The other end of a line: it numbers its replies, and spoils the next one.
#[derive(Default)]
struct End {
    number: u8,
    next: Option<Answer>,
    is_answering: bool,
}

fn reply_to(request: &[u8], unit: u8, number: u8) -> Vec<u8> {
    if request[0] == 2 {
        let mut reply = vec![2, 10, unit, request[3] & 0x0F | 0x20, request[4], 0, request[6], 0, 0, 0, number];
        reply.push(reply.iter().fold(0, |check, byte| check ^ byte));
        return reply;
    }
    let pdu = [unit, 3, 2, 0, number];
    match framing_of(request) {
        Framing::Tcp => [&request[..4], &[0, 5], &pdu].concat(),
        Framing::Rtu => [&pdu[..], &crc(&pdu).to_le_bytes()].concat(),
    }
}

fn serve(mut stream: TcpStream, end: &Mutex<End>, is_noisy: &AtomicBool) {
    let mut request = [0; 260];
    while let Ok(length @ 1..) = stream.read(&mut request) {
        let request = &request[..length];
        let (number, next) = {
            let mut end = end.lock().unwrap();
            end.number = end.number % 250 + 1;
            end.is_answering = true;
            (end.number, end.next.take())
        };
        let unit = request[if framing_of(request) == Framing::Tcp { 6 } else if request[0] == 2 { 2 } else { 0 }];
        let reply = reply_to(request, unit, number);
        let foreign = reply_to(request, unit ^ 8, number);
        let mut say = |bytes: &[u8]| stream.write_all(bytes);
        let rest = || sleep(Duration::from_millis(3));
        let written = match next {
            None => say(&reply),
            Some(Answer::Spoiled(spoil, at)) => say(&spoil(&reply, at)),
            Some(Answer::Late) => {
                sleep(timeout() * 3 / 2);
                say(&reply)
            }
            Some(Answer::Doubled) => say(&reply.repeat(2)),
            Some(Answer::Repeated) => say(&reply).and_then(|()| {
                rest();
                say(&reply)
            }),
            Some(Answer::Foreign) => say(&foreign),
            Some(Answer::BehindForeign) => say(&foreign).and_then(|()| {
                rest();
                say(&reply)
            }),
            Some(Answer::JoinedToForeign) => say(&[foreign, reply].concat()),
            Some(Answer::InPieces) => reply.chunks(1).try_for_each(|byte| {
                rest();
                say(byte)
            }),
            Some(Answer::TooMuch) => say(&[0x55; 3000]),
            Some(Answer::Noise) => {
                while is_noisy.load(Ordering::Relaxed) && say(&[0x55]).is_ok() {
                    rest();
                }
                Ok(())
            }
        };
        end.lock().unwrap().is_answering = false;
        if written.is_err() {
            break;
        }
    }
}

/// A socket as a UART: it tells whether bytes have come.
struct Port(TcpStream);

impl ::embedded_io::ErrorType for Port {
    type Error = ::embedded_io::ErrorKind;
}

impl ::embedded_io::Read for Port {
    fn read(&mut self, bytes: &mut [u8]) -> Result<usize, Self::Error> {
        self.0.read(bytes).map_err(|_| ::embedded_io::ErrorKind::Other)
    }
}

impl ::embedded_io::ReadReady for Port {
    fn read_ready(&mut self) -> Result<bool, Self::Error> {
        Ok(self.0.peek(&mut [0]).is_ok())
    }
}

impl ::embedded_io::Write for Port {
    fn write(&mut self, bytes: &[u8]) -> Result<usize, Self::Error> {
        self.0.write(bytes).map_err(|_| ::embedded_io::ErrorKind::Other)
    }

    fn flush(&mut self) -> Result<(), Self::Error> {
        Ok(())
    }
}

/// What failed, as the conformance vectors name it.
trait Named {
    fn named(&self) -> &'static str;
}

impl Named for std::io::Error {
    fn named(&self) -> &'static str {
        match self.kind() {
            ErrorKind::TimedOut | ErrorKind::WouldBlock => "timeout",
            ErrorKind::InvalidData => "invalid",
            ErrorKind::UnexpectedEof => "closed",
            _ => "line",
        }
    }
}

impl<E> Named for LineError<E> {
    fn named(&self) -> &'static str {
        if matches!(self, Self::TimedOut) { "timeout" } else { "line" }
    }
}

type Read1 = Box<dyn FnMut() -> Result<u8, &'static str> + Send>;

/// The low byte of what was read, or why nothing was.
fn told<R: Into<u64>, E: Named>(read: Result<R, ClientError<E>>) -> Result<u8, &'static str> {
    read.map(|raw| raw.into() as u8).map_err(|error| match error {
        ClientError::Transport(error, _) => error.named(),
        error => error.name(),
    })
}

fn modbus<T: Transport<Error: Named> + Send + 'static>(line: T, framing: Framing) -> Read1 {
    let mut client = Client::new(line, framing, 1).with_profile(&GATEWAY);
    Box::new(move || told(client.read_raw::<p::BaseFrequency>()))
}

fn tokio(line: tokio_modbus::Line, framing: Framing) -> Read1 {
    let runtime = Builder::new_current_thread().enable_all().build().unwrap();
    let mut client = AsyncClient::new(line.timeout(timeout()), framing, 1).with_profile(&GATEWAY);
    Box::new(move || told(runtime.block_on(client.read_raw::<p::BaseFrequency>())))
}

fn uss<T: Transport<Error: Named> + Send + 'static>(line: T) -> Read1 {
    use siemens_mm4::{points as p, Client, Link};
    let mut client = Client::new(line, Link::new(4, 0), 1);
    Box::new(move || told(client.read_raw::<p::MaximumFrequency>()))
}

fn stream(address: &str) -> TcpStream {
    let stream = TcpStream::connect(address).unwrap();
    stream.set_nodelay(true).unwrap();
    stream.set_read_timeout(Some(timeout())).unwrap();
    stream
}

/// Throws away what has come, as a serial port does at once.
fn clear(stream: &mut TcpStream) -> std::io::Result<()> {
    stream.set_nonblocking(true)?;
    while stream.read(&mut [0; 256]).is_ok() {}
    stream.set_nonblocking(false)
}

/// The statuses of a line, one after the other; equal ones that follow each other are counted.
fn statuses(name: &str, size: usize, connect: fn(String) -> Read1) -> Vec<String> {
    let (end, is_noisy) = (Arc::new(Mutex::new(End::default())), Arc::new(AtomicBool::new(false)));
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = listener.local_addr().unwrap().to_string();
    let (ends, noises) = (Arc::clone(&end), Arc::clone(&is_noisy));
    spawn(move || {
        for stream in listener.incoming() {
            let (end, is_noisy) = (Arc::clone(&ends), Arc::clone(&noises));
            spawn(move || {
                let stream = stream.unwrap();
                stream.set_nodelay(true).unwrap();
                serve(stream, &end, &is_noisy);
            });
        }
    });
    let mut read = connect(address);
    let mut spoiled = |answer: Answer| {
        end.lock().unwrap().next = Some(answer);
        is_noisy.store(true, Ordering::Relaxed);
        let before = Instant::now();
        let found = read();
        assert!(before.elapsed() < MOST, "{name}: {found:?} after {:?}", before.elapsed());
        is_noisy.store(false, Ordering::Relaxed);
        sleep(timeout() / 5);
        while found.is_ok() && end.lock().unwrap().is_answering {
            sleep(timeout() / 5); // the other end is slow
        }
        assert_eq!(read(), Ok(end.lock().unwrap().number), "{name}: the next reply after {found:?}");
        found.err().unwrap_or("ok")
    };
    let mut found: Vec<Vec<&str>> = Vec::new();
    for fault in AT_EACH_BYTE {
        found.push((0..size).map(|at| spoiled(Answer::Spoiled(fault, at))).collect());
    }
    use Answer::{BehindForeign, Doubled, Foreign, InPieces, JoinedToForeign, Late, Noise, Repeated, TooMuch};
    let whole = [Late, Doubled, Repeated, Foreign, BehindForeign, JoinedToForeign, InPieces, Noise, TooMuch];
    let is_tokio = name.starts_with("tokio"); // a reply that comes once more is the library's next one
    let whole = whole.into_iter().filter(|answer| !(is_tokio && matches!(answer, Repeated)));
    found.push(whole.map(spoiled).collect());
    found.iter().map(|statuses| counted(statuses)).collect()
}

fn counted(statuses: &[&str]) -> String {
    let mut runs: VecDeque<(&str, usize)> = VecDeque::new();
    for status in statuses {
        match runs.back_mut() {
            Some((last, times)) if last == status => *times += 1,
            _ => runs.push_back((status, 1)),
        }
    }
    let texts = runs.iter().map(|(status, times)| if *times == 1 { (*status).into() } else { format!("{status}*{times}") });
    texts.collect::<Vec<String>>().join(" ")
}

/// A line that is never silent, and has a byte in time for each read.
struct Endless;

impl Read for Endless {
    fn read(&mut self, space: &mut [u8]) -> std::io::Result<usize> {
        sleep(Duration::from_millis(TIMEOUTS[0]));
        space[0] = 0x55;
        Ok(1)
    }
}

impl Write for Endless {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

fn endless() {
    let before = Instant::now();
    let mut line = StreamLine::new(Endless);
    let mut reply = [0; 256];
    let lengths = [(); 2].map(|()| line.exchange(&[1, 3, 0x10, 0x28, 0, 1, 0, 0xC2], &mut reply).unwrap());
    assert!(lengths.iter().all(|length| *length > 0) && before.elapsed() < Duration::from_secs(14), "{lengths:?}");
}

/// The errors by position: broken, cut, without the byte, with it twice. The last row is of whole replies.
type Errors = [&'static str; 5];
const TCP: Errors = [
    "wrong_transaction*2 bad_protocol*2 short_frame*2 wrong_unit wrong_function bad_byte_count ok*2",
    "timeout short_frame*10",
    "short_frame*5 long_frame short_frame*5",
    "bad_protocol*2 long_frame*3 wrong_unit wrong_function bad_byte_count ok*3",
    "timeout ok*2 wrong_unit*3 ok bad_protocol*2",
];
const RTU: Errors = [
    "bad_crc*2 short_frame bad_crc*4",
    "timeout short_frame*6",
    "bad_crc*3 short_frame*4",
    "bad_crc*6 ok",
    "timeout ok*2 wrong_unit ok*3 bad_crc*2",
];
const USS: Errors = [
    "wrong_start wrong_length wrong_check*10",
    "timeout wrong_length*11",
    "wrong_start wrong_length*11",
    "wrong_length wrong_check*10 ok",
    "timeout ok*2 wrong_unit ok*3 wrong_start*2",
];
/// It does not look behind the frame of another.
const UART: Errors = [RTU[0], RTU[1], RTU[2], RTU[3], "timeout ok*2 wrong_unit*3 ok bad_crc*2"];
/// The library's errors; it drops bytes until a frame is right.
const TOKIO_TCP: Errors = [
    "invalid*4 timeout*2 invalid wrong_function invalid ok*2",
    "timeout*11",
    "timeout*5 closed timeout*5",
    "invalid*8 ok*3",
    "timeout ok invalid*3 ok timeout*2",
];
const TOKIO_RTU: Errors = [
    "timeout*7",
    "timeout*7",
    "timeout*7",
    "ok timeout*5 ok",
    "timeout ok invalid*3 ok timeout invalid",
];

type Case = (&'static str, usize, fn(String) -> Read1, Errors);

const CASES: &[Case] = &[
    ("TcpLine TCP", 11, |to| modbus(TcpLine::new(to).timeout(timeout()), Framing::Tcp), TCP),
    ("TcpLine RTU", 7, |to| modbus(TcpLine::new(to).timeout(timeout()), Framing::Rtu), RTU),
    ("StreamLine RTU", 7, |to| modbus(StreamLine::new(stream(&to)).clearing(clear), Framing::Rtu), RTU),
    ("embedded_io RTU", 7, |to| {
        let port = stream(&to);
        port.set_nonblocking(true).unwrap();
        let mut since = Instant::now();
        let wait = move |waited: u32| {
            if waited <= 1 {
                since = Instant::now();
            }
            sleep(Duration::from_millis(1));
            since.elapsed() < timeout()
        };
        modbus(embedded_io::Line::new(Port(port), wait), Framing::Rtu)
    }, UART),
    ("tokio-modbus TCP", 11, |to| {
        let to = to.parse().unwrap();
        tokio(tokio_modbus::Line::new(move || ::tokio_modbus::client::tcp::connect(to)), Framing::Tcp)
    }, TOKIO_TCP),
    ("tokio-modbus RTU", 7, |to| {
        let connect = move || {
            let to = to.clone();
            async move { tokio::net::TcpStream::connect(to).await.map(::tokio_modbus::client::rtu::attach) }
        };
        tokio(tokio_modbus::Line::new(connect), Framing::Rtu)
    }, TOKIO_RTU),
    ("TcpLine USS", 12, |to| uss(TcpLine::speaking(Protocol::Uss, to).timeout(timeout())), USS),
    ("StreamLine USS", 12, |to| uss(StreamLine::speaking(Protocol::Uss, stream(&to)).clearing(clear)), USS),
];

/// The cases whose statuses differ from the expected ones.
fn wrong(cases: &[&'static Case]) -> Vec<&'static Case> {
    let found: Vec<Vec<String>> = scope(|threads| {
        let running: Vec<_> =
            cases.iter().map(|(name, size, connect, _)| threads.spawn(|| statuses(name, *size, *connect))).collect();
        running.into_iter().map(|thread| thread.join().unwrap_or_default()).collect()
    });
    let wrong = cases.iter().zip(&found).filter(|((_, _, _, expected), found)| *expected != found[..]);
    let told = wrong.inspect(|((name, ..), found)| eprintln!("{name} at {:?}: {found:#?}", timeout()));
    told.map(|(case, _)| *case).collect()
}

fn main() {
    programs::log::keep();
    let mut left: Vec<&Case> = CASES.iter().collect();
    let never_silent = spawn(endless);
    for milliseconds in TIMEOUTS {
        TIMEOUT.store(milliseconds, Ordering::Relaxed);
        left = wrong(&left);
    }
    assert!(left.is_empty());
    never_silent.join().unwrap();
    let messages = programs::log::kept();
    for message in ["unit 1 -> 01 03 10 28 00 01 00 C2", "unit 1 <- 01 03 02 00 02 39 85", "unit 1 -> 02 0A 01 14 3A 00 00 00 00 00 00 27", "unit 1: failed: nothing was sent, or nothing came"] {
        assert!(messages.iter().any(|one| one == message), "{message}: {:#?}", &messages[..9]);
    }
}
