//! What a contact law does to the yield force: the styles of all codes side by side, at one material.

use super::number::{digits, friction, small};
use super::table::{Columns, DataTable, markdown_code};
use crate::code::Code;
use crate::model::TangentialStiffening;
use crate::study::Verdict;
use crate::study::yield_force::Judgement;

/// One style of a code, and its rows.
struct Style<'a> {
    code: Code,
    rows: Vec<&'a Judgement>,
}

fn styles(judgements: &[Judgement]) -> Vec<Style<'_>> {
    let mut styles: Vec<Style> = Vec::new();
    for row in judgements {
        match styles.iter_mut().find(|style| style.code == row.code) {
            Some(style) => style.rows.push(row),
            None => styles.push(Style {
                code: row.code,
                rows: vec![row],
            }),
        }
    }
    styles
}

/// For people: what each style means by a contact.
fn conventions(judgements: &[Judgement]) -> DataTable<'_> {
    let law = |style: &Style| style.rows[0].study.convention.law;
    Columns::<Style>::for_people()
        .left("code", |style| style.code.as_str().to_owned())
        .left("style", |style| style.code.label())
        .left("springs remember", move |style| {
            law(style).history.to_string()
        })
        .right("floor K / pair K", move |style| {
            digits::<4>(law(style).floor_ratio)
        })
        .left("k_t times 2/(2 - overlap)", move |style| {
            match law(style).tangential_stiffening {
                TangentialStiffening::None => "-".to_owned(),
                contacts => contacts.as_str().to_owned(),
            }
        })
        .right("pair arm", |style| {
            style.rows[0].study.convention.arms.pair.to_string()
        })
        .right("floor arm", |style| {
            style.rows[0].study.convention.arms.floor.to_string()
        })
        .rows(styles(judgements))
}

/// For people: slip onset and largest force of each style at each friction, at one stiffness.
fn forces(judgements: &[Judgement], stiffness: f64) -> DataTable<'_> {
    let rows: Vec<&Judgement> = judgements
        .iter()
        .filter(|row| row.stiffness() == stiffness)
        .collect();
    let mut frictions: Vec<f64> = rows.iter().map(|row| row.mu()).collect();
    frictions.sort_by(f64::total_cmp);
    frictions.dedup();
    let mut columns = Columns::<Style>::for_people().left("code", |style| style.code.to_string());
    for mu in frictions {
        // A page is made once.
        let heading: &'static str = format!("mu = {}", friction(mu)).leak();
        columns = columns.right(heading, move |style| {
            let mut own = style.rows.iter();
            let row = own.find(|row| row.mu() == mu && row.stiffness() == stiffness);
            row.map_or_else(String::new, |row| exact_forces(row))
        });
    }
    columns.rows(styles(judgements))
}

/// The onset, and the peak where it is another force.
fn exact_forces(row: &Judgement) -> String {
    let shown = digits::<5>;
    let limit = &row.study.limit;
    match (limit.slip_onset, limit.yield_force) {
        (Some(onset), Some(peak)) if onset < peak => format!("{} / {}", shown(onset), shown(peak)),
        (_, Some(peak)) => shown(peak),
        _ => "-".to_owned(),
    }
}

/// For people: how well each style was measured to have its own limit.
fn agreement(judgements: &[Judgement]) -> DataTable<'_> {
    let agreeing = |style: &Style| {
        let own = style.rows.iter();
        own.filter(|row| row.verdict() == Verdict::Agrees).count()
    };
    let largest = |style: &Style| {
        let errors = style.rows.iter().filter_map(|row| row.error());
        errors.map(f64::abs).reduce(f64::max)
    };
    Columns::<Style>::for_people()
        .left("code", |style| style.code.to_string())
        .left("version", |style| style.rows[0].version.clone())
        .left("runs", |style| style.rows[0].source.as_str().to_owned())
        .right("rows that agree", move |style| {
            format!("{} of {}", agreeing(style), style.rows.len())
        })
        .right("largest error", move |style| {
            largest(style).map_or_else(|| "-".to_owned(), small)
        })
        .rows(styles(judgements))
}

/// The page with the styles, their forces and how well they were measured; `figure` is the name of its picture.
pub(crate) fn laws_markdown(judgements: &[Judgement], figure: &str, command: &str) -> String {
    let mut stiffnesses: Vec<f64> = judgements.iter().map(Judgement::stiffness).collect();
    stiffnesses.sort_by(f64::total_cmp);
    stiffnesses.dedup();
    let mut page = format!(
        "# What your contact law does to the yield force\n\n\
         Every code calls it Hertz or Mindlin, and the same stack of the same material (Poisson's ratio 0.3) begins to slip \
         at other forces in each: by what its tangential spring remembers, by how stiff its floor is beside a pair, and \
         where forces act. This page has the exact quasi-static limits of all of them side by side, and how well each code \
         was measured to have its own. A code that agrees here does what its row says, and two rows that differ are two \
         models, not an error of either.\n\n\
         Made by tristack {} with {}. The equations are in docs/theory.md, section 11.\n\n\
         ![Load at the onset of slip over the floor friction]({figure})\n\n\
         ## What each style means by a contact\n\n",
        env!("CARGO_PKG_VERSION"),
        markdown_code(command)
    );
    page += &conventions(judgements).shown().markdown();
    page += "\nAn arm r1 is that of the torque, in R = r + r1 overlap, with that of the surface velocity where it is another \
             one. Springs that remember a displacement have the force of the present stiffness; those that remember a force \
             grow by the present stiffness alone. A spring that is rescaled is reduced while the contact opens, and has the \
             limit of one that is not where every contact is loaded all the way, as here.\n";
    for stiffness in stiffnesses {
        page += &format!(
            "\n## Onset of slip / largest force F, K r^1.5/(m g) = {stiffness}\n\nOne number where both are the same.\n\n"
        );
        page += &forces(judgements, stiffness).shown().markdown();
    }
    page += "\n## Measured\n\nThe error is the distance of the measured slip onset from the exact one, relative to F + 3.\n\n";
    page + &agreement(judgements).shown().markdown()
}
