//! tokio-modbus on a real server in both framings, and on one that does not answer.

use std::io::ErrorKind;
use std::net::SocketAddr;
use std::time::{Duration, Instant};

use hitachi_l200::enums::RunCommand;
use hitachi_l200::runtime::modbus::{Profile, Request};
use hitachi_l200::runtime::transports::tokio_modbus::Line;
use hitachi_l200::{blocks, points as p, AsyncClient, ClientError, Framing, ReplyError, PROFILE};
use tokio::io::AsyncReadExt;
use tokio::net::{TcpListener, TcpStream};
use tokio_modbus::client::{rtu, tcp, Context};

static GATEWAY: Profile = PROFILE.with_framings(&[Framing::Tcp]);

async fn talks(line: Line, profile: &'static Profile, framing: Framing) {
    let mut client = AsyncClient::new(line, framing, 1).with_profile(profile);
    assert_eq!(client.read::<p::OutputFrequency>().await.unwrap(), 0.7);
    client.write::<p::BaseFrequency>(50.0).await.unwrap();
    assert_eq!(client.read::<p::BaseFrequency>().await.unwrap(), 50.0);
    client.write::<p::AccelerationTime>(12.34).await.unwrap();
    assert_eq!(client.read::<p::AccelerationTime>().await.unwrap(), 12.34);
    client.write::<p::RunCommand>(RunCommand::Run).await.unwrap();
    assert_eq!(client.read::<p::RunCommand>().await.unwrap(), RunCommand::Run);
    let coils = Request::write_values(1, 15, 1, &[1, 0, 1, 0, 0, 0, 0, 0, 1]); // as many as no padding changes
    client.exchange(coils).await.unwrap();
    let reply = client.read_block(&blocks::COILS[0]).await.unwrap();
    assert_eq!(reply.items().collect::<Vec<_>>(), [1, 1, 0, 1, 0, 0, 0, 0, 0, 1, 0]);
    let refused = client.exchange(Request::new(1, 3, 0x2000, 1)).await.unwrap_err();
    assert!(matches!(refused, ClientError::Reply(ReplyError::Exception { code: 2, .. }, Some(_))), "{refused}");
    let spawned = tokio::spawn(async move { client.read::<p::BaseFrequency>().await });
    assert_eq!(spawned.await.unwrap().unwrap(), 50.0);
}

fn kind(error: &ClientError<std::io::Error>) -> Option<ErrorKind> {
    match error {
        ClientError::Transport(error, _) => Some(error.kind()),
        _ => None,
    }
}

/// A line that connects to these servers, one after the other, and again to the last.
fn line(servers: impl IntoIterator<Item = SocketAddr>) -> Line {
    let mut servers: Vec<SocketAddr> = servers.into_iter().collect();
    servers.reverse();
    Line::new(move || {
        let server = if servers.len() > 1 { servers.pop() } else { servers.last().copied() }.unwrap();
        async move { TcpStream::connect(server).await.map(rtu::attach) }
    })
    .timeout(Duration::from_millis(50))
}

async fn whoever_does_not_answer_is_left(server: SocketAddr) {
    let silent = TcpListener::bind("127.0.0.1:0").await.unwrap();
    let nobody = silent.local_addr().unwrap();
    let mut client = AsyncClient::new(line([nobody, server]), Framing::Rtu, 1);
    let late = client.read::<p::OutputFrequency>().await.unwrap_err();
    assert_eq!(kind(&late), Some(ErrorKind::TimedOut), "{late}");
    assert_eq!(client.read::<p::OutputFrequency>().await.unwrap(), 0.7);
    let closed = silent.accept().await.unwrap().0.read(&mut [0; 64]).await; // the request, then the end
    assert_eq!(closed.unwrap(), 8);

    let mut client = AsyncClient::new(line([nobody, server]), Framing::Rtu, 1);
    let dropped = tokio::time::timeout(Duration::from_millis(10), client.read::<p::OutputFrequency>()).await;
    assert!(dropped.is_err());
    assert!(client.transport().context().is_none());
    assert_eq!(client.read::<p::OutputFrequency>().await.unwrap(), 0.7);
    assert!(client.transport().context().is_some());
    let (mut heard, _) = silent.accept().await.unwrap();
    while heard.read(&mut [0; 64]).await.unwrap() > 0 {} // it was closed

    let patient = line([nobody]).timeout(Duration::from_secs(60)).turnaround(Duration::from_millis(50));
    let mut client = AsyncClient::new(patient, Framing::Rtu, 1);
    let for_all = Request::write::<p::BaseFrequency>(0, 500);
    let before = Instant::now();
    for _ in 0..2 {
        assert!(client.exchange(for_all).await.unwrap().is_none()); // and waits until all have done it
    }
    let took = before.elapsed();
    assert!(took >= Duration::from_millis(100) && took < Duration::from_secs(30), "{took:?}");
    assert!(client.transport().context().is_some());

    drop(silent);
    let refused = AsyncClient::new(line([nobody]), Framing::Rtu, 1).read::<p::OutputFrequency>().await.unwrap_err();
    assert_eq!(kind(&refused), Some(ErrorKind::ConnectionRefused), "{refused}");
    let never = Line::new(std::future::pending::<std::io::Result<Context>>).timeout(Duration::from_millis(50));
    let late = AsyncClient::new(never, Framing::Rtu, 1).read::<p::OutputFrequency>().await.unwrap_err();
    assert_eq!(kind(&late), Some(ErrorKind::TimedOut), "{late}");
}

#[tokio::main(flavor = "current_thread")]
async fn main() {
    let ports: Vec<u16> = std::env::args().skip(1).map(|port| port.parse().unwrap()).collect();
    let [serial, net] = [ports[0], ports[1]].map(|port| SocketAddr::from(([127, 0, 0, 1], port)));
    talks(line([serial]), &PROFILE, Framing::Rtu).await;
    talks(Line::new(move || tcp::connect(net)), &GATEWAY, Framing::Tcp).await;
    talks(Line::new(move || tcp::connect(net)), &PROFILE, Framing::Rtu).await; // ours need not be the wire's
    whoever_does_not_answer_is_left(serial).await;
}
