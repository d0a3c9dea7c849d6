//! Durations on the command line: with units, or as Slurm writes them.

use jiff::SignedDuration;
use std::time::Duration;

/// Reads a duration: `90s`, `1h 30min`, or `[D-][HH:]MM:SS`.
pub(super) fn duration(text: &str) -> Result<Duration, String> {
    let found = match text.contains(':') {
        true => of_clock(text),
        false => of_units(text),
    };
    let found = found.filter(|duration| !duration.is_zero());
    found
        .ok_or_else(|| "accepted is a time above 0, as 90s, 1h 30min, or [D-][HH:]MM:SS".to_owned())
}

/// Reads a duration with units. A bare number is refused: it is seconds to some programs, and minutes to Slurm.
fn of_units(text: &str) -> Option<Duration> {
    let parsed: SignedDuration = text.parse().ok()?;
    parsed.try_into().ok()
}

/// Reads a duration as `squeue --format=%L` prints it.
fn of_clock(text: &str) -> Option<Duration> {
    let (days, clock) = text.split_once('-').unwrap_or(("0", text));
    let parts: Option<Vec<u64>> = clock.split(':').map(number).collect();
    let [hours, minutes, seconds] = match parts?[..] {
        [minutes, seconds] => [0, minutes, seconds],
        [hours, minutes, seconds] => [hours, minutes, seconds],
        _ => return None,
    };
    let hours = number(days)?.checked_mul(24)?.checked_add(hours)?;
    let minutes = hours.checked_mul(60)?.checked_add(minutes)?;
    let seconds = minutes.checked_mul(60)?.checked_add(seconds)?;
    Some(Duration::from_secs(seconds))
}

fn number(text: &str) -> Option<u64> {
    let digits = text.bytes().all(|digit| digit.is_ascii_digit());
    text.parse().ok().filter(|_| digits)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_duration_has_units_or_is_written_as_slurm_does() {
        let written = [
            ("90s", 90),
            ("90 s", 90),
            ("30min", 1800),
            ("1h 30min", 5400),
            ("2 hours", 7200),
            ("0:07", 7),
            ("59:59", 3599),
            ("1:00:00", 3600),
            ("2-01:00:00", 176_400),
            ("2-23:59", 2 * 86_400 + 23 * 60 + 59),
        ];
        for (text, seconds) in written {
            assert_eq!(duration(text), Ok(Duration::from_secs(seconds)), "{text}");
        }
    }

    #[test]
    fn other_words_are_no_duration() {
        let words = [
            "",
            "90",
            "-90s",
            "0s",
            "0:00",
            "1:",
            ":1",
            "a:b",
            "1:2:3:4",
            "+1:00",
            "-1:00",
            "1-",
            "UNLIMITED",
            "1-2-3:00",
            "99999999999999999999:00",
            "18446744073709551615-00:00:00",
        ];
        for text in words {
            assert!(duration(text).is_err(), "{text}");
        }
    }
}
