//! Frames: a message with its checksum, between two zero bytes.
//!
//! `(header, message) => 0x00, COBS(version, postcard(header, message), CRC-32), 0x00`. COBS (Cheshire & Baker
//! 1999) leaves no other zero in a frame, so a receiver finds the next frame after any damage. The CRC is that of
//! IEEE 802.3, little-endian, over version, header and message.

use crc::{CRC_32_ISO_HDLC, Crc};

use crate::message::{Header, MAX_CHANGES, MAX_VALUES, Message, VERSION};

/// \[bytes\] maximum content of a frame: an [`Outputs`](crate::message::Outputs) with all values and changes.
pub const MAX_CONTENT: usize = 1 + 8 + 1 + 48 + 8 * MAX_VALUES + 15 * MAX_CHANGES + 4;
/// \[bytes\] maximum length of a frame.
pub const MAX_FRAME: usize = MAX_CONTENT + MAX_CONTENT / 254 + 3;
/// \[bytes\] of the checksum.
const CHECKSUM: usize = 4;

static CRC: Crc<u32> = Crc::<u32>::new(&CRC_32_ISO_HDLC);

/// A buffer of one frame.
#[derive(Clone, Debug)]
pub struct Frame {
    bytes: [u8; MAX_FRAME],
    length: usize,
}

impl Default for Frame {
    fn default() -> Self {
        Self { bytes: [0; MAX_FRAME], length: 0 }
    }
}

impl Frame {
    /// The frame's bytes, including both zeros; empty if nothing was encoded.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        self.bytes.get(..self.length).unwrap_or_default()
    }

    /// Encodes a message, replacing the contents.
    pub fn encode(&mut self, header: Header, message: &Message) {
        self.length = self.encoded(header, message).unwrap_or(0);
    }

    /// The frame's length; `None` if the message does not fit, which is impossible for messages of this crate.
    fn encoded(&mut self, header: Header, message: &Message) -> Option<usize> {
        let mut content = [0; MAX_CONTENT];
        content[0] = VERSION;
        let body = content.get_mut(1..MAX_CONTENT - CHECKSUM)?;
        let length = 1 + postcard::to_slice(&(header, message), body).ok()?.len();
        let checksum = CRC.checksum(content.get(..length)?);
        content.get_mut(length..length + CHECKSUM)?.copy_from_slice(&checksum.to_le_bytes());
        self.bytes[0] = 0;
        let last = MAX_FRAME - 1;
        let content = content.get(..length + CHECKSUM)?;
        let length = cobs::try_encode(content, self.bytes.get_mut(1..last)?).ok()?;
        *self.bytes.get_mut(1 + length)? = 0;
        Some(length + 2)
    }
}

/// Why bytes between two zeros are not a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameError {
    /// More bytes than any frame has.
    Oversize,
    /// Not COBS.
    Stuffing,
    /// The checksum differs.
    Checksum,
    /// Another version of the protocol.
    Version(u8),
    /// Not a message of this version.
    Message,
}

/// Collects bytes into frames and decodes them.
#[derive(Clone, Debug)]
pub struct Receiver {
    bytes: [u8; MAX_FRAME],
    length: usize,
}

impl Default for Receiver {
    fn default() -> Self {
        Self { bytes: [0; MAX_FRAME], length: 0 }
    }
}

impl Receiver {
    /// Processes a byte of the line; returns the message if it ends a frame. A frame that is too long is reported once,
    /// at its end.
    ///
    /// # Errors
    /// [`FrameError`] if the bytes are not a frame.
    pub fn push(&mut self, byte: u8) -> Result<Option<(Header, Message)>, FrameError> {
        if byte != 0 {
            if let Some(free) = self.bytes.get_mut(self.length) {
                *free = byte;
            }
            // One more than the buffer size indicates that it was too long.
            self.length = (self.length + 1).min(MAX_FRAME + 1);
            return Ok(None);
        }
        match core::mem::take(&mut self.length) {
            0 => Ok(None),
            length => self.decode(length).map(Some),
        }
    }

    fn decode(&mut self, length: usize) -> Result<(Header, Message), FrameError> {
        let stuffed = self.bytes.get_mut(..length).ok_or(FrameError::Oversize)?;
        let report = cobs::decode_in_place_report(stuffed).map_err(|_| FrameError::Stuffing)?;
        if report.src_used != length {
            return Err(FrameError::Stuffing);
        }
        let content = stuffed.get(..report.dst_used).ok_or(FrameError::Stuffing)?;
        let (content, checksum) =
            content.split_last_chunk::<CHECKSUM>().ok_or(FrameError::Checksum)?;
        if CRC.checksum(content) != u32::from_le_bytes(*checksum) {
            return Err(FrameError::Checksum);
        }
        let (&version, body) = content.split_first().ok_or(FrameError::Message)?;
        if version != VERSION {
            return Err(FrameError::Version(version));
        }
        match postcard::take_from_bytes(body) {
            Ok((decoded, [])) => Ok(decoded),
            _ => Err(FrameError::Message),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use proptest::prelude::*;

    use super::*;
    use crate::message::{Change, Chunk, Hello, Identity, Inputs, Outputs, Settings, Values};

    fn received(bytes: &[u8]) -> Vec<Result<(Header, Message), FrameError>> {
        let mut receiver = Receiver::default();
        bytes.iter().filter_map(|byte| receiver.push(*byte).transpose()).collect()
    }

    fn encoded(header: Header, message: &Message) -> Vec<u8> {
        let mut frame = Frame::default();
        frame.encode(header, message);
        frame.bytes().to_vec()
    }

    fn largest() -> Message {
        let change = Change { step: u64::MAX, sequence: u32::MAX };
        Message::Outputs(Outputs {
            step: u64::MAX,
            running: true,
            hash: u64::MAX,
            received: u32::MAX,
            values: Values::from_iter([f64::MAX; MAX_VALUES]),
            changes: core::iter::repeat_n(change, MAX_CHANGES).collect(),
        })
    }

    const LAST: Header = Header { session: u16::MAX, sequence: u32::MAX };

    #[test]
    fn every_message_fits_and_returns() {
        let identity = Identity { step: 1e-3, ..Identity::default() };
        let hello = Hello { identity, settings: Settings::default() };
        let chunk = Chunk { total: 300, offset: 128, bytes: [0; 128].into() };
        let outputs = Outputs { step: 3, hash: 7, ..Outputs::default() };
        for message in [
            largest(),
            Message::Hello(hello),
            Message::Saved(chunk),
            Message::Outputs(outputs),
            Message::Inputs(Inputs { step: 0, values: Values::from_iter([0.0, -0.0, 1e300]) }),
            Message::Inputs(Inputs { step: 0, values: Values::from_iter([-0.0, f64::INFINITY]) }),
            Message::Goodbye,
        ] {
            let bytes = encoded(LAST, &message);
            assert!(!bytes.is_empty() && bytes.len() <= MAX_FRAME, "{}", bytes.len());
            assert_eq!(bytes.iter().filter(|byte| **byte == 0).count(), 2);
            assert_eq!(received(&bytes), [Ok((LAST, message))]);
        }
    }

    /// The bytes of a frame, for other implementations of the protocol; documented in docs/hil.md.
    #[test]
    fn a_frame_is_these_bytes() {
        let message = Message::Inputs(Inputs { step: 300, values: Values::from_iter([1.5]) });
        let bytes = encoded(Header { session: 7, sequence: 2 }, &message);
        let content = [1, 7, 2, 3, 0xac, 2, 0, 1, 0, 0, 0xc0, 0x3f];
        let mut decoded = [0; 64];
        let length = cobs::decode(&bytes[1..bytes.len() - 1], &mut decoded).unwrap();
        assert_eq!(decoded[..length - 4], content);
        assert_eq!(decoded[length - 4..length], CRC.checksum(&content).to_le_bytes());
        // The check value of this CRC's definition.
        assert_eq!(CRC.checksum(b"123456789"), 0xcbf4_3926);
    }

    #[test]
    fn damage_is_named_and_the_next_frame_is_received() {
        let good = encoded(LAST, &Message::Goodbye);
        let after = |damaged: &[u8]| {
            let mut bytes = damaged.to_vec();
            bytes.extend(&good);
            let mut all = received(&bytes);
            assert_eq!(all.pop(), Some(Ok((LAST, Message::Goodbye))));
            all
        };
        let long = [&[0][..], &[1; 2 * MAX_FRAME], &[0]].concat();
        assert_eq!(after(&long), [Err(FrameError::Oversize)]);
        let mut flipped = good.clone();
        flipped[4] ^= 2;
        assert!(matches!(after(&flipped)[..], [Err(_)]));
        assert!(matches!(after(&good[..good.len() - 3])[..], [Err(_)]));
        assert_eq!(after(&[0, 0, 0]), []);
        let mut content = [2, 0, 0, 11, 0, 0, 0, 0];
        let seal = CRC.checksum(&content[..4]).to_le_bytes();
        content[4..].copy_from_slice(&seal);
        let mut other = [0; 16];
        let length = cobs::encode(&content, &mut other);
        assert_eq!(after(&other[..length]), [Err(FrameError::Version(2))]);
        // A message with an extra byte.
        let mut content = [VERSION, 0, 0, 11, 9, 0, 0, 0, 0];
        let seal = CRC.checksum(&content[..5]).to_le_bytes();
        content[5..].copy_from_slice(&seal);
        let length = cobs::encode(&content, &mut other);
        assert_eq!(after(&other[..length]), [Err(FrameError::Message)]);
    }

    proptest! {
        /// For any behaviour of the line, only sent messages are received, and the receiver recovers.
        #[test]
        fn noise_is_never_a_message(noise: Vec<u8>, cut in 0_usize..700, flip in 0_usize..5600) {
            let frame = encoded(LAST, &largest());
            let mut damaged = frame.clone();
            damaged.truncate(cut.max(1));
            let at = flip / 8 % damaged.len();
            damaged[at] ^= 1 << (flip % 8);
            let bytes = [&noise[..], &damaged, &frame].concat();
            let all = received(&bytes);
            prop_assert_eq!(all.iter().flatten().count(), 1, "{:?}", all);
            prop_assert_eq!(all.last(), Some(&Ok((LAST, largest()))));
        }
    }
}
