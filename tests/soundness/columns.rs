//! Results whose columns have other names, other units and other signs, as a manifest says.

use super::scenes::{short_case, short_test};
use super::{Seed, marked, series};
use tristack::code::ResultFormat;
use tristack::dem::{compress_stack, run_contact_test};
use tristack::series::{ColumnSource, ColumnSources, Motion, Series};

const FORMATS: [ResultFormat; 2] = [ResultFormat::Csv, ResultFormat::LammpsThermo];

/// The first line of an input names columns, `wall_force=f*-1;...`; the rest is a result.
pub fn check(data: &[u8]) {
    let Some((&kind, rest)) = data.split_first() else {
        return;
    };
    let end = rest.iter().position(|&byte| byte == b'\n');
    let (line, content) = rest.split_at(end.map_or(rest.len(), |end| end + 1));
    let sources = sources(&String::from_utf8_lossy(line));
    let format = FORMATS[usize::from(kind) % FORMATS.len()];
    if kind / 2 % 2 == 0 {
        let case = short_case();
        match format.series(content, &sources, &case) {
            Ok(accepted) => series::is_sound(&accepted, &case),
            Err(refusal) => assert!(!refusal.to_string().is_empty()),
        }
        return;
    }
    let test = short_test();
    match format.motion(content, &sources, &test) {
        Ok(motion) => assert_eq!(motion.rows().len() as u64, test.steps + 1),
        Err(refusal) => assert!(!refusal.to_string().is_empty()),
    }
}

/// Those that a manifest may hold: known names, factors that are finite and not zero, none for the step.
fn sources(line: &str) -> ColumnSources {
    let entries = line.trim_end().split(';').filter_map(|entry| {
        let (name, source) = entry.split_once('=')?;
        let (from, factor) = source.split_once('*').unwrap_or((source, "1"));
        let factor: f64 = factor.parse().ok()?;
        let known = Series::COLUMNS.contains(&name) || Motion::COLUMNS.contains(&name);
        let is_accepted = factor.is_finite() && factor != 0.0 && (name != "step" || factor == 1.0);
        let from = from.to_owned();
        (known && is_accepted).then(|| (name.to_owned(), ColumnSource { from, factor }))
    });
    entries.collect()
}

pub fn seeds() -> Vec<Seed> {
    let run = compress_stack(&short_case(), || true).expect("a finite series");
    let csv = String::from_utf8(run.to_csv()).expect("text");
    let renamed = csv.replacen("wall_force", "f_top", 1);
    let motion = run_contact_test(&short_test()).expect("a finite motion");
    let motion = String::from_utf8(motion.to_csv()).expect("text");
    let table = |text: &str| format!("{}Loop time of 2\n", text.replace(',', " "));
    let inputs = [
        (0, "wall_force=f_top*-2.5;x1=theta1", renamed.clone()),
        (
            0,
            "floor_n2=floor_n3;floor_n3=floor_n2*1e300;step=step*1",
            csv.clone(),
        ),
        (1, "wall_force=f_top", table(&renamed)),
        (2, "fx1=fy1*1e-300;vx1=x1", motion.clone()),
        (3, "wall_force=fx2", table(&motion)),
    ];
    let named = inputs
        .into_iter()
        .enumerate()
        .map(|(index, (kind, line, text))| {
            (
                format!("columns-{index}"),
                marked(kind, format!("{line}\n{text}")),
            )
        });
    named.collect()
}
