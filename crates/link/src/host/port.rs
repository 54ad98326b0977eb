//! Addresses of ports, and open ports.
//!
//! `unix:PATH, unix-listen:PATH, tcp:HOST:PORT, tcp-listen:HOST:PORT, /dev/tty…[@BAUD], COM3[@BAUD] => port`.

use std::fmt;
use std::io::{self, Read, Write};
use std::net::{Shutdown, TcpListener, TcpStream};
#[cfg(unix)]
use std::os::unix::net::{UnixListener, UnixStream};
use std::path::PathBuf;
use std::str::FromStr;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

use thiserror::Error;

/// \[bit/s\] default bit rate of a serial port.
const BAUD: u32 = 115_200;
/// \[bytes\] size of a read.
const BUFFER: usize = 4096;
/// Interval at which a reading thread checks whether its port was closed, and at which opening a port is retried.
const GLANCE: Duration = Duration::from_millis(50);

/// Address of the other end.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Address {
    /// A Unix socket at which another program listens, as QEMU does.
    Unix(PathBuf),
    /// A Unix socket at which this program listens.
    UnixListen(PathBuf),
    /// `HOST:PORT` at which another program listens.
    Tcp(String),
    /// `HOST:PORT` at which this program listens.
    TcpListen(String),
    /// A serial port, and its bit rate \[bit/s\].
    Serial(String, u32),
}

/// An error of a port.
#[derive(Debug, Error)]
pub enum PortError {
    /// It is not an address.
    #[error("`{0}` is not a port: {1}")]
    Address(String, &'static str),
    /// It does not open.
    #[error("cannot open {address}: {reason}")]
    Open {
        /// The address.
        address: Address,
        /// The reason.
        reason: io::Error,
    },
}

impl FromStr for Address {
    type Err = PortError;

    fn from_str(text: &str) -> Result<Self, PortError> {
        let refused = |reason| Err(PortError::Address(text.to_owned(), reason));
        match text.split_once(':') {
            Some((_, "")) => refused("nothing follows the colon"),
            #[cfg(unix)]
            Some(("unix", path)) => Ok(Self::Unix(path.into())),
            #[cfg(unix)]
            Some(("unix-listen", path)) => Ok(Self::UnixListen(path.into())),
            #[cfg(not(unix))]
            Some(("unix" | "unix-listen", _)) => refused("this system has no Unix sockets"),
            Some((kind @ ("tcp" | "tcp-listen"), host)) => match host.rsplit_once(':') {
                Some((name, port)) if !name.is_empty() && port.parse::<u16>().is_ok() => {
                    let host = host.to_owned();
                    Ok(if kind == "tcp" { Self::Tcp(host) } else { Self::TcpListen(host) })
                }
                _ => refused("tcp needs HOST:PORT, e.g. tcp:127.0.0.1:5555"),
            },
            _ => {
                let (path, baud) = match text.rsplit_once('@') {
                    Some((path, baud)) => (path, baud.parse().ok().filter(|baud| *baud > 0)),
                    None => (text, Some(BAUD)),
                };
                let serial = path.starts_with('/') || path.to_ascii_uppercase().starts_with("COM");
                match baud {
                    Some(baud) if serial => Ok(Self::Serial(path.to_owned(), baud)),
                    None => refused("give a bit rate after @, e.g. /dev/ttyACM0@921600"),
                    Some(_) => refused(
                        "expected unix:PATH, unix-listen:PATH, tcp:HOST:PORT, tcp-listen:HOST:PORT, \
                         /dev/tty…[@BAUD] or COM3[@BAUD]",
                    ),
                }
            }
        }
    }
}

impl fmt::Display for Address {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unix(path) => write!(f, "unix:{}", path.display()),
            Self::UnixListen(path) => write!(f, "unix-listen:{}", path.display()),
            Self::Tcp(host) => write!(f, "tcp:{host}"),
            Self::TcpListen(host) => write!(f, "tcp-listen:{host}"),
            Self::Serial(path, baud) => write!(f, "{path}@{baud}"),
        }
    }
}

/// An open port; a thread reads it, because a socket's timeouts are too coarse for a tick.
pub struct Port {
    writer: Box<dyn Write + Send>,
    bytes: Receiver<Vec<u8>>,
    close: Arc<AtomicBool>,
    shut: Box<dyn Fn() + Send>,
}

impl Port {
    /// Opens a port, retrying for up to `patience`.
    ///
    /// # Errors
    /// [`PortError::Open`] with the last reason.
    pub fn open(address: &Address, patience: Duration) -> Result<Self, PortError> {
        let end = Instant::now() + patience;
        let failed = |reason| PortError::Open { address: address.clone(), reason };
        loop {
            match Self::try_open(address, end) {
                Ok(port) => return Ok(port),
                Err(reason) if Instant::now() >= end => return Err(failed(reason)),
                Err(_) => thread::sleep(GLANCE.min(end - Instant::now())),
            }
        }
    }

    fn try_open(address: &Address, end: Instant) -> io::Result<Self> {
        match address {
            #[cfg(unix)]
            Address::Unix(path) => Self::of_unix(UnixStream::connect(path)?),
            #[cfg(unix)]
            Address::UnixListen(path) => {
                // Removes the socket of an earlier program; other files are kept.
                if UnixStream::connect(path).is_err() && is_socket(path) {
                    std::fs::remove_file(path)?;
                }
                let listener = UnixListener::bind(path)?;
                listener.set_nonblocking(true)?;
                let stream = accepted(end, || listener.accept().map(|(stream, _)| stream))?;
                std::fs::remove_file(path)?;
                stream.set_nonblocking(false)?;
                Self::of_unix(stream)
            }
            #[cfg(not(unix))]
            Address::Unix(_) | Address::UnixListen(_) => Err(io::ErrorKind::Unsupported.into()),
            Address::Tcp(host) => Self::of_tcp(TcpStream::connect(host)?),
            Address::TcpListen(host) => {
                let listener = TcpListener::bind(host)?;
                listener.set_nonblocking(true)?;
                let stream = accepted(end, || listener.accept().map(|(stream, _)| stream))?;
                stream.set_nonblocking(false)?;
                Self::of_tcp(stream)
            }
            Address::Serial(path, baud) => {
                let port = serialport::new(path, *baud).timeout(GLANCE).open()?;
                let reader = port.try_clone()?;
                Ok(Self::of(Box::new(reader), Box::new(port), Box::new(|| {})))
            }
        }
    }

    #[cfg(unix)]
    fn of_unix(stream: UnixStream) -> io::Result<Self> {
        stream.set_read_timeout(Some(GLANCE))?;
        let (reader, other) = (stream.try_clone()?, stream.try_clone()?);
        let shut = move || _ = other.shutdown(Shutdown::Both);
        Ok(Self::of(Box::new(reader), Box::new(stream), Box::new(shut)))
    }

    fn of_tcp(stream: TcpStream) -> io::Result<Self> {
        stream.set_nodelay(true)?;
        stream.set_read_timeout(Some(GLANCE))?;
        let (reader, other) = (stream.try_clone()?, stream.try_clone()?);
        let shut = move || _ = other.shutdown(Shutdown::Both);
        Ok(Self::of(Box::new(reader), Box::new(stream), Box::new(shut)))
    }

    fn of(
        mut reader: Box<dyn Read + Send>,
        writer: Box<dyn Write + Send>,
        shut: Box<dyn Fn() + Send>,
    ) -> Self {
        let close = Arc::new(AtomicBool::new(false));
        let (sender, bytes) = channel();
        let closed = Arc::clone(&close);
        thread::spawn(move || {
            let mut buffer = [0; BUFFER];
            // A frame ends with a zero: a waiting thread is woken only then.
            let mut piece = Vec::new();
            while !closed.load(Ordering::Relaxed) {
                use io::ErrorKind::{Interrupted, TimedOut, WouldBlock};
                match reader.read(&mut buffer) {
                    Ok(0) => break,
                    Ok(count) => {
                        piece.extend_from_slice(&buffer[..count]);
                        let is_due = piece.len() > BUFFER || buffer[..count].contains(&0);
                        if is_due && sender.send(std::mem::take(&mut piece)).is_err() {
                            break;
                        }
                    }
                    Err(error) if matches!(error.kind(), Interrupted | TimedOut | WouldBlock) => {}
                    Err(_) => break,
                }
            }
        });
        Self { writer, bytes, close, shut }
    }

    /// The bytes that arrived until `end`, possibly none; `None` if the port is closed.
    pub fn read(&mut self, end: Instant) -> Option<Vec<u8>> {
        match self.bytes.recv_timeout(end.saturating_duration_since(Instant::now())) {
            Ok(bytes) => Some(bytes),
            Err(RecvTimeoutError::Timeout) => Some(Vec::new()),
            Err(RecvTimeoutError::Disconnected) => None,
        }
    }

    /// Sends bytes; returns whether the port accepted them.
    pub fn write(&mut self, bytes: &[u8]) -> bool {
        self.writer.write_all(bytes).and_then(|()| self.writer.flush()).is_ok()
    }
}

impl Drop for Port {
    fn drop(&mut self) {
        self.close.store(true, Ordering::Relaxed);
        (self.shut)();
    }
}

/// Accepts until `end`.
fn accepted<S>(end: Instant, mut accept: impl FnMut() -> io::Result<S>) -> io::Result<S> {
    loop {
        match accept() {
            Err(error) if error.kind() == io::ErrorKind::WouldBlock => {
                if Instant::now() >= end {
                    return Err(io::Error::new(io::ErrorKind::TimedOut, "no connection"));
                }
                thread::sleep(Duration::from_millis(2));
            }
            other => return other,
        }
    }
}

#[cfg(unix)]
fn is_socket(path: &std::path::Path) -> bool {
    use std::os::unix::fs::FileTypeExt as _;
    std::fs::symlink_metadata(path).is_ok_and(|data| data.file_type().is_socket())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_are_read_and_shown() {
        for text in ["tcp:127.0.0.1:5555", "tcp-listen:[::1]:1", "/dev/ttyACM0@921600", "COM3@9600"]
        {
            assert_eq!(text.parse::<Address>().unwrap().to_string(), text);
        }
        let serial = Address::Serial("/dev/ttyS0".to_owned(), BAUD);
        assert_eq!("/dev/ttyS0".parse::<Address>().unwrap(), serial);
        for text in
            ["", "x", "unix:", "tcp:host", "tcp::1", "tcp:a:70000", "/dev/x@", "/dev/x@fast"]
        {
            let error = text.parse::<Address>().unwrap_err().to_string();
            assert!(error.contains("is not a port"), "{error}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn a_file_in_the_way_stays() {
        let path = std::env::temp_dir().join(format!("dbd-link-{}", std::process::id()));
        std::fs::write(&path, "kept").unwrap();
        let opened = Port::open(&Address::UnixListen(path.clone()), Duration::ZERO);
        assert!(opened.is_err());
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "kept");
        std::fs::remove_file(&path).unwrap();
    }
}
