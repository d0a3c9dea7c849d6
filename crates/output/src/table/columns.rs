//! The declaration of a table's columns.

use super::value::{Typed, ValueKind};
use super::{DataTable, Value};
use crate::code::{Code, KnownConvention};
use crate::model::{Arms, HistoryUpdate, Law, Stack};
use crate::number::{friction, or_dash};
use crate::study::{Cause, Source, Verdict};
use serde::Serialize;
use std::borrow::Cow;
use std::rc::Rc;

/// Name, version and origin of a machine-readable table.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Schema {
    pub(crate) name: &'static str,
    /// Raised when a column is removed or changes its meaning.
    pub(crate) version: u32,
    /// One sentence on the meaning of a row.
    pub(crate) what: &'static str,
    /// The commands and files that carry it.
    pub(crate) found_in: &'static str,
}

type ValueOf<'a, R> = Box<dyn Fn(&R) -> Value + 'a>;
type CellOf<'a, R> = Box<dyn Fn(&R) -> String + 'a>;

/// A column of a table with rows of type `R`.
pub(super) struct Column<'a, R> {
    /// Name in CSV and JSON; empty for a column that is for people only.
    pub name: Cow<'static, str>,
    /// Unit of a number, `1` for a pure one; empty for a text.
    pub unit: &'static str,
    pub meaning: Cow<'static, str>,
    pub kind: ValueKind,
    /// Whether a value may be missing.
    pub is_optional: bool,
    /// Name in tables for people; `None` for a column that they leave out.
    pub heading: Option<Cow<'static, str>>,
    /// Its heading on a page with mathematics, if that differs.
    pub title: Option<&'static str>,
    value: ValueOf<'a, R>,
    /// Format of its numbers in tables for people.
    digits: fn(f64) -> String,
    /// Text for people in place of the value.
    cell: Option<CellOf<'a, R>>,
    /// The order in which a narrow terminal leaves columns out, from 1; `None` for a column that always stays.
    pub dispensable: Option<u8>,
    /// Whether verdicts in its cells are coloured.
    pub has_verdicts: bool,
    /// Whether its texts come from outside, such as the version that a program states: they have no notation.
    pub is_from_outside: bool,
}

impl<'a, R: 'a> Column<'a, R> {
    pub fn value(&self, row: &R) -> Value {
        (self.value)(row)
    }

    /// Formats the value for people.
    pub fn cell(&self, row: &R) -> String {
        match &self.cell {
            Some(cell) => cell(row),
            None => self.value(row).shown(self.digits),
        }
    }

    /// Converts the column to one that takes the index of a row.
    fn of(self, rows: Rc<[R]>) -> Column<'a, usize> {
        let Self { value, cell, .. } = self;
        let of_value = rows.clone();
        Column {
            value: Box::new(move |&row| value(&of_value[row])),
            cell: cell.map(|cell| Box::new(move |&row: &usize| cell(&rows[row])) as CellOf<_>),
            name: self.name,
            unit: self.unit,
            meaning: self.meaning,
            kind: self.kind,
            is_optional: self.is_optional,
            heading: self.heading,
            title: self.title,
            digits: self.digits,
            dispensable: self.dispensable,
            has_verdicts: self.has_verdicts,
            is_from_outside: self.is_from_outside,
        }
    }
}

/// The columns of a table with rows of type `R`, in order.
///
/// Methods such as `means`, `shown`, `digits` and `cell` concern the column declared last, or the one named by
/// [`Columns::again`].
pub(crate) struct Columns<'a, R> {
    schema: Schema,
    list: Vec<Column<'a, R>>,
    current: usize,
}

impl<'a, R: 'a> Columns<'a, R> {
    /// Starts version 1 of a table, without columns.
    pub(crate) fn new(name: &'static str, what: &'static str, found_in: &'static str) -> Self {
        Self {
            schema: Schema {
                name,
                version: 1,
                what,
                found_in,
            },
            list: Vec::new(),
            current: 0,
        }
    }

    /// Starts a table that only people read, without columns.
    pub(crate) fn for_people() -> Self {
        Self::new("", "", "")
    }

    /// Adds a column of numbers in `unit`, `1` for pure numbers.
    pub(crate) fn number<V: Typed>(
        mut self,
        name: impl Into<Cow<'static, str>>,
        unit: &'static str,
        value: impl Fn(&R) -> V + 'a,
    ) -> Self {
        self.current = self.list.len();
        self.list.push(Column {
            name: name.into(),
            unit,
            meaning: "".into(),
            kind: V::KIND,
            is_optional: V::IS_OPTIONAL,
            heading: None,
            title: None,
            value: Box::new(move |row| value(row).into()),
            digits: |number| number.to_string(),
            cell: None,
            dispensable: None,
            has_verdicts: false,
            is_from_outside: false,
        });
        self
    }

    /// Adds a column of words or flags.
    pub(crate) fn text<V: Typed>(
        self,
        name: impl Into<Cow<'static, str>>,
        value: impl Fn(&R) -> V + 'a,
    ) -> Self {
        self.number(name, "", value)
    }

    /// Adds a column of the words that enum variants have in files, such as `floor-slip`.
    pub(crate) fn word<V: Serialize>(
        self,
        name: &'static str,
        value: impl Fn(&R) -> V + 'a,
    ) -> Self {
        self.text(name, move |row| Value::word(value(row)))
    }

    /// Says in docs/formats.md what the column means.
    pub(crate) fn means(mut self, meaning: impl Into<Cow<'static, str>>) -> Self {
        self.current().meaning = meaning.into();
        self
    }

    /// Says whether a value may be missing, where its type leaves that open.
    pub(crate) fn missing_where(mut self, is_optional: bool) -> Self {
        self.current().is_optional = is_optional;
        self
    }

    /// Adds a column for people only, aligned to the left.
    pub(crate) fn left(
        self,
        heading: impl Into<Cow<'static, str>>,
        cell: impl Fn(&R) -> String + 'a,
    ) -> Self {
        self.text("", cell).means("").shown(heading)
    }

    /// Adds a column for people only, aligned to the right.
    pub(crate) fn right(
        self,
        heading: impl Into<Cow<'static, str>>,
        cell: impl Fn(&R) -> String + 'a,
    ) -> Self {
        self.number("", "1", cell).means("").shown(heading)
    }

    /// Shows the column to people as `heading`, its numbers formatted by `digits`.
    pub(crate) fn shown_as(
        self,
        heading: impl Into<Cow<'static, str>>,
        digits: fn(f64) -> String,
    ) -> Self {
        self.shown(heading).digits(digits)
    }

    /// Shows the column to people as `heading`.
    pub(crate) fn shown(mut self, heading: impl Into<Cow<'static, str>>) -> Self {
        self.current().heading = Some(heading.into());
        self
    }

    /// Shows the column as `title` on a page with mathematics.
    pub(crate) fn titled(mut self, title: &'static str) -> Self {
        self.current().title = Some(title);
        self
    }

    /// Leaves the column out of a terminal that is too narrow for all, in this `order`: the first to go has 1.
    pub(crate) fn dispensable(mut self, order: u8) -> Self {
        self.current().dispensable = Some(order);
        self
    }

    /// Says that the texts of the column come from outside, so that dollar signs and backticks in them are no notation
    /// on pages.
    pub(crate) fn of_outside(mut self) -> Self {
        self.current().is_from_outside = true;
        self
    }

    /// Colours verdicts in its cells on a terminal.
    pub(crate) fn with_verdicts(mut self) -> Self {
        self.current().has_verdicts = true;
        self
    }

    /// Formats its numbers for people by `digits`.
    pub(crate) fn digits(mut self, digits: fn(f64) -> String) -> Self {
        self.current().digits = digits;
        self
    }

    /// Shows people this text in place of the value.
    pub(crate) fn cell(mut self, cell: impl Fn(&R) -> String + 'a) -> Self {
        self.current().cell = Some(Box::new(cell));
        self
    }

    /// Goes back to the column `name`.
    pub(crate) fn again(mut self, name: &str) -> Self {
        let declared = self.list.iter().position(|column| column.name == name);
        self.current = declared.expect("the column was declared before");
        self
    }

    fn current(&mut self) -> &mut Column<'a, R> {
        &mut self.list[self.current]
    }

    /// Adds the parameters of a stack; people see stiffness and floor friction.
    pub(crate) fn stack(self, stack: impl Fn(&R) -> Stack + Copy + 'a) -> Self {
        let stiffness = move |row: &R| Some(stack(row).stiffness).filter(|own| own.is_finite());
        self.number("stiffness", "m g/r", stiffness)
            .means("normal stiffness k_n, 1/ε; absent where bodies are rigid")
            .shown("stiffness")
            .number("mu", "1", move |row| stack(row).floor_friction)
            .means("floor friction μ")
            .shown("mu")
            .titled("$\\mu$")
            .digits(friction)
            .number("mu_d", "1", move |row| stack(row).cylinder_friction)
            .means("friction μ_d between the bodies")
            .number("kappa", "1", move |row| {
                let own = stack(row);
                own.stiffness.is_finite().then_some(own.stiffness_ratio)
            })
            .means("stiffness ratio κ = k_n/k_t; absent where bodies are rigid")
            .number("bodies", "1", move |row| u64::from(stack(row).bodies))
            .means("number n of bodies on the floor: 2 cylinders, or 3 to 5 spheres in a ring")
    }

    /// Adds the part of a contact convention that moves the quasi-static limit; its columns are empty where it is not known.
    pub(crate) fn convention(
        self,
        convention: impl Fn(&R) -> Option<KnownConvention> + Copy + 'a,
    ) -> Self {
        let arm = move |row: &R, arm: fn(&Arms<Option<f64>>) -> Option<f64>| {
            convention(row).and_then(|convention| arm(&convention.arms))
        };
        let pair = "arm coefficient r₁ of the torque of cylinder–cylinder contacts; absent where it is not known";
        let floor = "the same of cylinder–wall contacts";
        let kinematic = "the same of the surface velocity";
        self.number("pair_torque_arm", "1", move |row| {
            arm(row, |arms| arms.pair.torque)
        })
        .means(pair)
        .number("pair_kinematic_arm", "1", move |row| {
            arm(row, |arms| arms.pair.kinematic)
        })
        .means(kinematic)
        .number("floor_torque_arm", "1", move |row| {
            arm(row, |arms| arms.floor.torque)
        })
        .means(floor)
        .number("floor_kinematic_arm", "1", move |row| {
            arm(row, |arms| arms.floor.kinematic)
        })
        .means(kinematic)
        .text("history_update", move |row| {
            let known = convention(row).and_then(|convention| convention.history_update);
            known.map(HistoryUpdate::as_str)
        })
        .means("treatment of the tangential spring of a turning contact")
    }

    /// Adds the contact law; its columns are empty where there is none.
    pub(crate) fn law(self, law: impl Fn(&R) -> Option<Law> + Copy + 'a) -> Self {
        self.number("law_power", "1", move |row| Some(law(row)?.power.value()))
            .means("power p of the normal force K overlapᵖ: 1 where springs are linear, 1.5 in Hertz's law; absent, like the rest of \
                    the law, where bodies are rigid")
            .text("history", move |row| Some(law(row)?.history.as_str()))
            .means("what tangential springs remember while their stiffness changes")
            .number("floor_ratio", "1", move |row| Some(law(row)?.floor_ratio))
            .means("K of the floor over K of cylinders")
            .number("floor_kappa", "1", move |row| law(row)?.floor_kappa)
            .means("stiffness ratio of the floor; absent where it is that of cylinders")
            .text("tangential_stiffening", move |row| Some(law(row)?.tangential_stiffening.as_str()))
            .means("contacts whose k_t is multiplied by 2/(2 − overlap): none, those of pairs, or every one")
    }

    /// Adds the code of a row.
    pub(crate) fn code(self, code: impl Fn(&R) -> &Code + 'a) -> Self {
        let name = move |row: &R| code(row).to_string();
        self.text("code", name)
            .means("name of the code")
            .shown("code")
    }

    /// Adds the version of the code, which is hidden from people until `shown` is called.
    pub(crate) fn version(self, version: impl Fn(&R) -> &str + Copy + 'a) -> Self {
        let text = move |row: &R| Value::from(version(row));
        self.text("version", text)
            .means("version of the code")
            .of_outside()
            .cell(move |row| or_dash(version(row)))
    }

    /// Adds the source of the runs of a row, which is hidden from people until `shown` is called.
    pub(crate) fn source(self, source: impl Fn(&R) -> Source + 'a) -> Self {
        let meaning = "`live` if it ran on this machine, `recorded` if recorded runs stand in for it, `files` if its results were \
             made elsewhere after a plan";
        self.text("source", move |row| source(row).as_str())
            .means(meaning)
    }

    /// Adds the verdict on a row.
    pub(crate) fn verdict(self, verdict: impl Fn(&R) -> Verdict + 'a) -> Self {
        let meaning = "`agrees`, `differs`, `inconclusive`, `no-yield`, `failed` or `missing`; `agrees` alone is a pass";
        self.text("verdict", move |row| verdict(row).as_str())
            .means(meaning)
            .shown("verdict")
            .with_verdicts()
    }

    /// Declares the column of the kind of reason for which a row is inconclusive.
    pub(crate) fn cause(self, cause: impl Fn(&R) -> Option<Cause> + 'a) -> Self {
        self.text("cause", move |row| cause(row).map(Cause::as_str))
            .means("the kind of reason for which the row is inconclusive; absent where it is not")
    }

    /// Completes the table with these `rows`.
    pub(crate) fn rows(self, rows: impl IntoIterator<Item = R>) -> DataTable<'a> {
        let explained = |column: &Column<R>| column.name.is_empty() || !column.meaning.is_empty();
        debug_assert!(
            self.list.iter().all(explained),
            "every column has a meaning"
        );
        let rows: Rc<[R]> = rows.into_iter().collect();
        let columns = self.list.into_iter();
        DataTable {
            schema: self.schema,
            rows: rows.len(),
            columns: columns.map(|column| column.of(rows.clone())).collect(),
        }
    }
}
