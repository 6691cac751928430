//! tokio-modbus on a real server in both framings, and on one that does not answer.

use std::io::ErrorKind;
use std::net::SocketAddr;
use std::time::Duration;

use hitachi_l200::enums::RunCommand;
use hitachi_l200::runtime::modbus::{Profile, ReplyError, Request};
use hitachi_l200::runtime::transports::tokio_modbus::Attached;
use hitachi_l200::{blocks, points as p, AsyncClient, ClientError, Framing, PROFILE};
use tokio::io::AsyncReadExt;
use tokio::net::{TcpListener, TcpStream};
use tokio_modbus::client::{rtu, tcp, Context};

static GATEWAY: Profile = PROFILE.with_framings(&[Framing::Tcp]);

async fn talks(context: Context, profile: &'static Profile, framing: Framing) {
    let mut client = AsyncClient::new(Attached::new(context), framing, 1).with_profile(profile);
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

async fn whoever_does_not_answer_is_given_up(server: SocketAddr) {
    let silent = TcpListener::bind("127.0.0.1:0").await.unwrap();
    let stream = TcpStream::connect(silent.local_addr().unwrap()).await.unwrap();
    let line = Attached::new(rtu::attach(stream)).timeout(Duration::from_millis(50));
    let mut client = AsyncClient::new(line, Framing::Rtu, 1);
    let late = client.read::<p::OutputFrequency>().await.unwrap_err();
    assert_eq!(kind(&late), Some(ErrorKind::TimedOut), "{late}");
    let gone = client.read::<p::OutputFrequency>().await.unwrap_err();
    assert_eq!(kind(&gone), Some(ErrorKind::NotConnected), "{gone}");
    let stream = TcpStream::connect(server).await.unwrap();
    client.transport().attach(rtu::attach(stream));
    assert_eq!(client.read::<p::OutputFrequency>().await.unwrap(), 0.7);

    let stream = TcpStream::connect(silent.local_addr().unwrap()).await.unwrap();
    client.transport().attach(rtu::attach(stream));
    let dropped = tokio::time::timeout(Duration::from_millis(10), client.read::<p::OutputFrequency>()).await;
    assert!(dropped.is_err());
    assert_eq!(kind(&client.read::<p::OutputFrequency>().await.unwrap_err()), Some(ErrorKind::NotConnected));

    let stream = TcpStream::connect(silent.local_addr().unwrap()).await.unwrap();
    client.transport().attach(rtu::attach(stream));
    client.transport().detach(); // a serial port could be opened anew
    assert!(client.transport().context().is_none());
    assert_eq!(kind(&client.read::<p::OutputFrequency>().await.unwrap_err()), Some(ErrorKind::NotConnected));
    let mut left = [0; 64];
    let (mut heard, _) = silent.accept().await.unwrap();
    for _ in 0..2 {
        heard = silent.accept().await.unwrap().0;
    }
    while heard.read(&mut left).await.unwrap() > 0 {} // it was closed

    let stream = TcpStream::connect(silent.local_addr().unwrap()).await.unwrap();
    client.transport().attach(rtu::attach(stream));
    let for_all = Request::write::<p::BaseFrequency>(0, 500);
    for _ in 0..2 {
        assert!(client.exchange(for_all).await.unwrap().is_none()); // and waits until all have done it
    }
}

#[tokio::main(flavor = "current_thread")]
async fn main() {
    let ports: Vec<u16> = std::env::args().skip(1).map(|port| port.parse().unwrap()).collect();
    let [serial, net] = [ports[0], ports[1]].map(|port| SocketAddr::from(([127, 0, 0, 1], port)));
    talks(rtu::attach(TcpStream::connect(serial).await.unwrap()), &PROFILE, Framing::Rtu).await;
    talks(tcp::connect(net).await.unwrap(), &GATEWAY, Framing::Tcp).await;
    talks(tcp::connect(net).await.unwrap(), &PROFILE, Framing::Rtu).await; // ours need not be the wire's
    whoever_does_not_answer_is_given_up(serial).await;
}
