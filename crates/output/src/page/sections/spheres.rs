//! Spheres in place of cylinders.

use super::super::document::{Block, Section};
use crate::DataTable;
use crate::figures::spheres_figure;
use crate::number::digits;
use crate::paper::reproduction::{BodiesCurve, Reproduction};
use crate::table::Columns;
use crate::theory::Event;

pub(super) fn section(reproduction: &Reproduction) -> Section {
    let spheres = &reproduction.spheres;
    let blocks = vec![
        Block::paragraph(
            "Most codes simulate spheres only, and in three dimensions they turn contact frames, springs and axes of rotation in \
             ways that a plane stack does not test. So the stack exists with $n = 3$, 4 or 5 equal spheres, too: they just touch in a \
             ring, one of their size lies on all of them, and the same wall presses it down. By symmetry each bottom \
             sphere stays in its meridian plane, and the exact limit of the cylinders, $n = 2$, carries over with another angle $\\psi_0$ \
             and other multiples of the weight (docs/theory.md, section 13). Six spheres lie around a seventh and do not carry it.",
        ),
        Block::figure(spheres_figure(spheres)),
        Block::table(
            "spheres",
            "The exact limit of two cylinders and of three to five spheres under the paper’s convention, but for springs that turn with \
             their contacts, as those of codes do. $\\psi_0$ is the angle of the line \
             between the centres of a bottom body and the top one from the vertical, $\\mu_c = \\tan(\\psi_0/2)$; below $\\mu_c/(n + 1)$ rigid \
             bodies slide under their own weight. $F$ at three floor frictions, in $mg$; rigid bodies have $n - 1$ at $\\mu_c/2$, and \
             no limit from $\\mu_c$ on. Above the highest $\\mu$ the top wall reaches the bottom bodies before the floor slips, or the top body \
             slips on them.",
            &limits(&spheres.curves),
        ),
    ];
    Section::new("spheres", "Spheres in three dimensions", blocks)
}

/// Names the event that ends a curve, in a few words.
fn ending(event: Event) -> &'static str {
    match event {
        Event::FloorSlip => "floor slips",
        Event::CylinderSlip => "top slips",
        Event::ContactCloses => "ring closes",
        Event::WallContact => "wall touches",
        Event::None => "path ends",
    }
}

/// Returns the table of geometry and limits of each stack.
pub(crate) fn limits(curves: &[BodiesCurve]) -> DataTable<'_> {
    let critical = |own: &&BodiesCurve| own.stack.ring().critical_friction;
    Columns::<&BodiesCurve>::new(
        "spheres",
        "A row is the exact limit under the paper's convention, with springs that turn, of so many bodies on the floor at one stiffness.",
        "`tristack report` (tables/spheres.csv)",
    )
    .number("bodies", "1", |own| u64::from(own.stack.bodies))
    .means("number n of bodies on the floor: 2 cylinders, or 3 to 5 spheres in a ring")
    .shown("$n$")
    .number("angle", "deg", |own| own.stack.ring().angle.to_degrees())
    .means("ψ₀, angle of the line between the centres of a bottom body and the top one from the vertical")
    .shown_as("$\\psi_0$, degrees", digits::<5>)
    .number("critical_friction", "1", critical)
    .means("μ_c, rigid critical floor friction")
    .shown_as("$\\mu_c$", digits::<6>)
    .number("own_weight_friction", "1", |own| own.own_weight_friction())
    .means("μ_c/(n + 1), below which rigid bodies slide under their own weight")
    .shown_as("$\\mu_c/(n + 1)$", digits::<5>)
    .number("stiffness", "m g/r", |own| own.stack.stiffness)
    .means("normal stiffness k_n, 1/ε")
    .shown("stiffness")
    .number("kappa", "1", |own| own.stack.stiffness_ratio)
    .means("stiffness ratio κ = k_n/k_t")
    .number("mu_d", "1", |own| own.stack.cylinder_friction)
    .means("friction μ_d between two bodies")
    .number("lowest_friction", "1", |own| own.frictions.0)
    .means("lowest floor friction at which the stack yields under the wall; it slides under its own weight below")
    .number("highest_friction", "1", |own| own.frictions.1)
    .means("highest floor friction at which the floor is the first to slip")
    .shown("yields for $\\mu$")
    .cell(|own| {
        let (lowest, highest) = own.frictions;
        format!("{lowest:.4} to {highest:.4}")
    })
    .text("ends_by", |own| own.ends_by.to_string())
    .means("what comes first above")
    .shown("ended by")
    .cell(|own| ending(own.ends_by).to_owned())
    .number("force_below", "m g", |own| own.forces[0])
    .means("F at μ_c/2")
    .shown_as("$F$ at $\\mu_c/2$", digits::<7>)
    .number("force_critical", "m g", |own| own.forces[1])
    .means("F at μ_c")
    .shown_as("$F$ at $\\mu_c$", digits::<7>)
    .number("force_above", "m g", |own| own.forces[2])
    .means("F at 1.1 μ_c")
    .shown_as("$F$ at $1.1\\,\\mu_c$", digits::<7>)
    .rows(curves)
}
