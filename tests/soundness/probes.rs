//! Micro-tests with arbitrary recorded motions: reading the contact law off them must not panic, and may fail.

use super::Seed;
use std::sync::LazyLock;
use tristack::code::Code;
use tristack::dem::run_contact_test;
use tristack::model::ContactTest;
use tristack::series::{Motion, MotionRow};
use tristack::study::convention::probe;

/// Bytes that say one change: micro-test (2), row (1), column (1), what becomes of the number (1).
const CHANGE: usize = 5;

/// The micro-tests of the first round and their motions.
static FIRST_ROUND: LazyLock<Vec<Vec<MotionRow>>> = LazyLock::new(|| {
    let mut rows = Vec::new();
    let stopped = probe(&Code::native().declaration(), |tests| {
        rows = tests
            .iter()
            .map(|test| honest(test).rows().to_vec())
            .collect();
        Err(())
    });
    assert!(stopped.is_err());
    rows
});

fn honest(test: &ContactTest) -> Motion {
    run_contact_test(test).expect("a finite motion")
}

pub fn check(data: &[u8]) {
    let mut motions = FIRST_ROUND.clone();
    for change in data.chunks_exact(CHANGE) {
        let test = usize::from(u16::from_le_bytes([change[0], change[1]])) % motions.len();
        let rows = &mut motions[test];
        let row = usize::from(change[2]) % rows.len();
        let value = column(&mut rows[row], change[3]);
        *value = changed(*value, change[4]);
    }
    let mut round = 0;
    let read = probe(&Code::native().declaration(), |tests| {
        round += 1;
        if round == 1 {
            return Ok(FIRST_ROUND
                .iter()
                .zip(&motions)
                .map(|(_, rows)| checked(rows))
                .collect());
        }
        // A number that was read off nonsense may be none; a run with it is refused, and the probe ends.
        tests
            .iter()
            .map(|test| run_contact_test(test).map_err(drop))
            .collect()
    });
    for property in read.unwrap_or_default() {
        let finding = property.judge(&Code::native(), "0");
        assert!(!finding.property.is_empty());
    }
}

fn checked(rows: &[MotionRow]) -> Motion {
    let last = rows.len() as u64 - 1;
    Motion::new(rows.to_vec(), last).expect("finite rows")
}

fn column(row: &mut MotionRow, which: u8) -> &mut f64 {
    match which % 17 {
        0 => &mut row.x1,
        1 => &mut row.y1,
        2 => &mut row.vx1,
        3 => &mut row.vy1,
        4 => &mut row.spin1,
        5 => &mut row.fx1,
        6 => &mut row.fy1,
        7 => &mut row.torque1,
        8 => &mut row.x2,
        9 => &mut row.y2,
        10 => &mut row.vx2,
        11 => &mut row.vy2,
        12 => &mut row.spin2,
        13 => &mut row.fx2,
        14 => &mut row.fy2,
        15 => &mut row.torque2,
        _ => &mut row.wall_force,
    }
}

fn changed(value: f64, how: u8) -> f64 {
    const NUMBERS: [f64; 8] = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        f64::MAX,
        f64::MIN,
        f64::MIN_POSITIVE,
        1e-320,
    ];
    let new = match how {
        0..8 => NUMBERS[usize::from(how)],
        8..64 => -value,
        64..128 => value * f64::from(how),
        128..192 => value * (1.0 + 1e-3 * f64::from(how)),
        _ => value + 1e-6 * f64::from(how),
    };
    if new.is_finite() { new } else { value }
}

pub fn seeds() -> Vec<Seed> {
    let inputs: [&[u8]; 4] = [
        &[],
        &[0, 0, 1, 5, 0],
        &[3, 0, 0, 4, 4, 9, 0, 1, 1, 150],
        &[20; 10],
    ];
    let seed = |(index, input): (usize, &[u8])| (format!("changes-{index}"), input.to_vec());
    inputs.into_iter().enumerate().map(seed).collect()
}
