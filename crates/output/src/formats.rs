//! docs/formats.md, generated from the declared columns.

use super::page::declared_tables;
use super::table::{Columns, DataTable};
use super::{
    all_durations, arm_effects, atlas_table, bench, boundaries, budget, check, code_durations,
    contradictions, crosscheck, crosscheck_summary, declared_explanations, forecasts, given_runs,
    given_series, impacts, inventory, judged_series, largest_forces, measured_convention,
    passport_changes, passport_forces, planned_runs, probe, published_files, published_forces,
    published_series, pyramids, regimes, scaling, simulations, stored, stored_entries,
    stored_files, theory, trajectories,
};
use crate::code::{Entry, Feature, LISTS, PARAMETERS, TaskKind};
use crate::model::PAPER_BODIES;
use crate::series::{Column, MotionRow, Sample};

const TOP: &str = "# Tables, results and parameters

Made from the declarations in the source (`tristack::output::formats_page`); a test compares, and
`TRISTACK_UPDATE_GOLDEN=1 cargo test --test documents formats` writes it anew.

Every table has the same columns and the same numbers, with all their digits, in CSV and in JSON. A missing value is an
empty field in CSV and `null` in JSON. A text that a spreadsheet would take for a formula (it begins with `=`, `+`, `-`,
`@`, a tab or a line break, and is no number) begins with an apostrophe in CSV; in JSON it stays as it is. Tables on a terminal, in Markdown and HTML show some of the columns, with
the digits that people want.

JSON is an object:

| key       | value                                                                                        |
|-----------|----------------------------------------------------------------------------------------------|
| `schema`  | `tristack/NAME/VERSION`; the version is raised when a column goes or changes its meaning     |
| `command` | the command that gives the same rows again, without what changes no number (`--out`, `--jobs`) |
| `units`   | the unit of every column of numbers, `1` for pure ones                                       |
| `rows`    | a list of objects, one a row                                                                 |

Where a command has several tables (`tristack regimes`), `schema` is `tristack/tables/1`, and `tables` is a list of
objects with `schema`, `units` and `rows`.

Units: mass m, radius r and normal stiffness k_n of the cylinders, and gravity g; forces F = f/(m g) are in m g.

`tristack schema` prints the same as JSON Schema, with the keys of manifests and the parameters of tasks.
";

const RESULTS: &str = "
# Results of codes

What a code delivers for a task, in CSV or as a table in its log, in the units r = m = k_n = 1. x points to the right, y
upwards, angles turn counter-clockwise.
";

const TASKS: &str = "
# Parameters of tasks

What a code is given for a task. Cylinder 1 is the top one, 2 the right one, 3 the left one. `rigid` is the task `stack` of a code
whose manifest has `contact = \"rigid\"`; the unit of force is m g there (k_n = m g/r in units and results), so that `gravity` is 1.

`schema` is raised when a parameter goes or changes its meaning, and then alone: further parameters and further numbers of
an entry may join, lists may get longer and tasks may name further features. So a code passes over names that it does
not know, and ends with a message where `features` names something that it does not have.

The file is one of these, by `format` under `[parameters]` of a manifest:

* `json`: an object. `bodies` is a list of objects, `features` a list of strings.
* `toml`: `name = number`, one a line, and after them the lists, each on a line of its own with the same content. The
  value of a list begins with `[`: a program that reads numbers line by line ends there, or passes over such lines.
* `lammps-variables`: `variable NAME string NUMBER`, one a line, for LAMMPS and LIGGGHTS. A list has its length under its
  name (`bodies`, `features`); numbers of its entries, which count from 1, are `bodies_1_radius`, `bodies_1_mass`, …; a
  feature that is on is 1 under `features_friction`, and one that is off has no variable. A deck that has friction alone:

      variable features_friction string 0
      include  task.in
      variable others equal ${features}-${features_friction}
      if \"${others} > 0\" then \"print 'features: friction alone is known here'\" \"quit 1\"

";

/// Returns the content of docs/formats.md: all machine-readable tables and files, with unit and meaning of each column.
pub fn formats_page() -> String {
    let tables = json_tables().into_iter();
    let tables = tables.map(|table| format!("\n{}", table.described()));
    let files = result_files().into_iter();
    let files = files.map(|file| format!("\n{}", file.described()));
    TOP.to_owned()
        + &tables.collect::<String>()
        + RESULTS
        + &files.collect::<String>()
        + TASKS
        + &task().described()
        + "\n"
        + &features().described()
}

/// Returns every table that is also written as JSON, without rows.
pub(super) fn json_tables() -> Vec<DataTable<'static>> {
    let mut tables = vec![
        crosscheck(&[]),
        crosscheck_summary(&[]),
        budget(&[]),
        trajectories(&[]),
        impacts(&[]),
        check(&[]),
        probe(&[]),
        measured_convention(&[]),
        arm_effects(&[]),
        atlas_table(&[]),
        passport_changes(&[]),
        passport_forces(&[]),
        regimes(&[], 0, 0),
        boundaries(&[]),
        largest_forces(&[]),
        published_forces(&[]),
        published_series(&[]),
        contradictions(&[]),
        published_files(&[]),
        given_runs(&[]),
        given_series(&[]),
        theory(&[]),
        forecasts(&[]),
        simulations(&[]),
        bench(&[]),
        scaling(&[]),
        pyramids(&[]),
        inventory(&[]),
        planned_runs(&[], &[]),
        code_durations(&[]),
        all_durations(&[]),
        stored(&[]),
        stored_entries(&[]),
        stored_files(&[]),
    ];
    tables.extend(declared_explanations());
    tables.extend(judged_series(None));
    tables.extend(declared_tables());
    tables
}

/// Returns the tables that declare the files that codes deliver, without rows.
pub(super) fn result_files() -> [DataTable<'static>; 4] {
    [
        file(
            "series",
            "A row is one moment of a compression. Positions and angles are those of its step, and forces those at these \
             positions; where they depend on velocities, on those that the code has then, half a step before in most.",
            "`tristack simulate` (series.csv, and its units in series.csv-metadata.json beside it, after W3C's \"CSV on the Web\"), \
             and the result of the tasks `stack` and `side-walls`",
            Sample::columns(PAPER_BODIES),
        ),
        file(
            "motion",
            "A row is one step of a micro-test, from step 0 on. Positions are those of its step, forces and torques those \
             at these positions.",
            "the result of the task `motion`",
            &MotionRow::COLUMNS,
        ),
        file(
            "spheres-series",
            "A row is one moment of a compression of spheres in space, y upwards. Of a stack of fewer spheres the columns of the \
             others are left out.",
            "`tristack simulate --bodies` (series.csv, and its units in series.csv-metadata.json), and the result of the task `spheres`",
            Sample::columns(5),
        ),
        file(
            "spheres-motion",
            "A row is one step of a micro-test of spheres in space, y upwards, from step 0 on.",
            "the result of the task `spheres-motion`",
            MotionRow::columns(true),
        ),
    ]
}

/// Returns the table that declares the parameters given to a deck.
fn task() -> DataTable<'static> {
    let mut columns = Columns::<()>::new(
        "task",
        "One object of numbers and, at the end of this table, lists: everything that a deck needs, in the units r = m = k_n = 1. \
         Each task has those of its own; a manifest with `content = \"deck\"` under `[parameters]` gets fewer, those that its \
         decks read, and no lists.",
        "task.json, or the file that `[parameters]` of a manifest names",
    );
    for parameter in PARAMETERS {
        let meaning = noted(parameter.meaning, parameter.tasks, parameter.when.limits());
        columns = columns
            .number(parameter.name, parameter.unit, |()| f64::NAN)
            .means(meaning);
    }
    for list in LISTS {
        columns = columns
            .text(list.name, |()| "")
            .means(noted(list.meaning, list.tasks, None));
        let Entry::Numbers(numbers) = list.entry else {
            continue;
        };
        for number in numbers {
            let name = format!("{}[].{}", list.name, number.name);
            columns = columns
                .number(name, number.unit, |()| f64::NAN)
                .means(number.meaning);
        }
    }
    columns.rows([])
}

/// Returns `meaning`, with the tasks and the condition in parentheses if there are any.
fn noted(meaning: &str, tasks: &[TaskKind], limits: Option<&str>) -> String {
    let kinds: Vec<&str> = tasks.iter().map(|kind| kind.as_str()).collect();
    let mut notes = Vec::new();
    if kinds.len() < TaskKind::ALL.len() {
        notes.push(kinds.join(", "));
    }
    notes.extend(limits.map(str::to_owned));
    match notes.is_empty() {
        true => meaning.to_owned(),
        false => format!("{meaning} ({})", notes.join("; ")),
    }
}

/// Returns the table that declares what may be named in `features` of a task.
fn features() -> DataTable<'static> {
    let mut columns = Columns::<()>::new(
        "features",
        "What contacts have beyond a spring and a dashpot along their normal, by name.",
        "`features` of a task",
    );
    for feature in Feature::ALL {
        columns = columns
            .text(feature.as_str(), |()| "")
            .means(feature.meaning());
    }
    columns.rows([])
}

fn file<R: 'static>(
    name: &'static str,
    row: &'static str,
    written_by: &'static str,
    declared: &[Column<R>],
) -> DataTable<'static> {
    let mut columns = Columns::<R>::new(name, row, written_by);
    for column in declared {
        let meaning = match column.is_optional {
            true => format!("{}; a code may leave it out", column.meaning),
            false => column.meaning.to_owned(),
        };
        columns = columns
            .number(column.name, column.unit, column.value)
            .means(meaning)
            .missing_where(column.is_optional);
    }
    columns.rows([])
}
