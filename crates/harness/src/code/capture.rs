//! Captures the beginning and the end of a program's output.

use std::collections::VecDeque;
use std::io::{Read, Write};
use std::sync::mpsc::{Receiver, channel};

const HEAD_BYTES: u64 = 1 << 20;
const TAIL_BYTES: usize = 1 << 16;

/// Copies a pipe to `output` on a separate thread, which sends `output` back once the copy is complete.
///
/// # Errors
/// If the system starts no thread.
pub(super) fn capture<W: Write + Send + 'static>(
    mut pipe: impl Read + Send + 'static,
    mut output: W,
) -> std::io::Result<Receiver<W>> {
    let (sender, copied) = channel();
    let copier = std::thread::Builder::new().spawn(move || {
        // Output that cannot be written is dropped, because a program is judged by its series.
        if copy(&mut pipe, &mut output).is_err() {
            let _ = std::io::copy(&mut pipe, &mut std::io::sink());
        }
        let _ = sender.send(output);
    });
    copier.map(|_| copied)
}

/// Copies the first bytes at once and the last ones at the end, with a note on how many were left out between them.
fn copy(mut pipe: impl Read, output: &mut impl Write) -> std::io::Result<()> {
    std::io::copy(&mut pipe.by_ref().take(HEAD_BYTES), output)?;
    let mut tail = VecDeque::new();
    let mut left_out = 0;
    let mut buffer = vec![0; TAIL_BYTES];
    loop {
        let count = pipe.read(&mut buffer)?;
        if count == 0 {
            break;
        }
        tail.extend(&buffer[..count]);
        let excess = tail.len().saturating_sub(TAIL_BYTES);
        tail.drain(..excess);
        left_out += excess;
    }
    if left_out > 0 {
        write!(output, "\n[{left_out} bytes left out]\n")?;
    }
    let (first, second) = tail.as_slices();
    output.write_all(first)?;
    output.write_all(second)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn captured(text: &[u8]) -> Vec<u8> {
        let mut output = Vec::new();
        copy(text, &mut output).unwrap();
        output
    }

    #[test]
    fn what_fits_is_kept_as_it_is() {
        let text: Vec<u8> = (0..HEAD_BYTES as usize + TAIL_BYTES)
            .map(|index| index as u8)
            .collect();
        assert_eq!(captured(&text), text);
        assert_eq!(captured(b""), b"");
    }

    #[test]
    fn of_more_the_beginning_and_the_end_are_kept() {
        let mut text = b"begin".to_vec();
        text.extend(vec![b'.'; 5_000_000]);
        text.extend(b"end");
        let kept = captured(&text);
        assert!(kept.starts_with(b"begin.") && kept.ends_with(b".end"));
        let marker = format!(
            "[{} bytes left out]",
            text.len() - (HEAD_BYTES as usize + TAIL_BYTES)
        );
        assert!(String::from_utf8_lossy(&kept).contains(&marker));
    }
}
