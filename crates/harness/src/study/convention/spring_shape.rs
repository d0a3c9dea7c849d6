//! How stiffness and damping of a tangential spring grow with the overlap, and what it remembers, found from motions
//! in which the overlap rises and falls.

use super::beside::fit_beside;
use super::contact_frame::ContactRow;
use super::linear_form::Form;
use super::regression::Measured;
use super::shape::{Growth, Memory};

/// Step over which slopes are taken, and rounds of Gauss–Newton.
const STEP: f64 = 1e-4;
const ROUNDS: usize = 8;
/// Growths of the damping from which the search begins, in units of that of the stiffness.
const DAMPINGS: [f64; 3] = [0.0, 0.5, 1.0];

/// Growth and memory of a spring ([`Growth`], [`Memory`]).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpringShape {
    /// Exponent of the stiffness.
    pub stiffness_exponent: Measured,
    /// Stiffening of the stiffness.
    pub stiffening: Measured,
    /// Exponent of the damping.
    pub damping_exponent: Measured,
    /// Stiffening of the damping.
    pub damping_stiffening: Measured,
    /// Force share of the memory; unknown where the stiffness is constant.
    pub force_share: Measured,
    /// Rescaling of the memory.
    pub rescaling: Measured,
    /// Transport ([`Form::transport`]); unknown where no contact turns.
    pub transport: Measured,
}

impl SpringShape {
    /// The known form that fits best, beside a normal stiffness with the growth `normal`.
    pub fn start(normal: Growth, motions: &[&[ContactRow]], radius: f64) -> Form {
        let forms = Memory::KNOWN.iter().flat_map(|&memory| {
            DAMPINGS.map(|share| Form {
                stiffness: normal,
                damping: Growth {
                    exponent: share * normal.exponent,
                    ..normal
                },
                memory,
                ..Form::PLAIN
            })
        });
        let left = |form: &Form| {
            let found = form.deviations(motions, radius);
            found.map_or(f64::INFINITY, |(mean, _)| mean)
        };
        let best = forms.min_by(|one, other| left(one).total_cmp(&left(other)));
        best.unwrap_or(Form::PLAIN)
    }

    /// The shape that fits best, its coefficients, and the form of both; the search begins at `form`.
    pub fn fit(form: Form, motions: &[&[ContactRow]], radius: f64) -> (Self, Vec<Measured>, Form) {
        let with = |numbers: [f64; 7]| shaped(form, numbers).terms(motions, radius);
        let found = fit_beside(numbers(form), STEP, ROUNDS, form.columns(motions), with);
        let [
            stiffness_exponent,
            stiffening,
            damping_exponent,
            damping_stiffening,
            force_share,
            rescaling,
            transport,
        ] = found.others;
        let shape = Self {
            stiffness_exponent,
            stiffening,
            damping_exponent,
            damping_stiffening,
            force_share,
            rescaling,
            transport,
        };
        (shape, found.coefficients, shaped(form, found.at))
    }

    /// Relative uncertainty of a force from that of the known numbers of the shape, at the overlaps of micro-tests:
    /// the logarithms of these and of their ratios are below 4.
    pub fn uncertainty(&self) -> f64 {
        let numbers = [
            self.stiffness_exponent,
            self.stiffening,
            self.damping_exponent,
            self.damping_stiffening,
            self.force_share,
            self.rescaling,
        ];
        let uncertainties = numbers.iter().map(|own| own.uncertainty);
        4.0 * uncertainties.filter(|own| own.is_finite()).sum::<f64>()
    }
}

fn numbers(form: Form) -> [f64; 7] {
    [
        form.stiffness.exponent,
        form.stiffness.stiffening,
        form.damping.exponent,
        form.damping.stiffening,
        form.memory.force_share,
        form.memory.rescaling,
        form.transport,
    ]
}

fn shaped(form: Form, numbers: [f64; 7]) -> Form {
    let growth = |exponent, stiffening| Growth {
        exponent,
        stiffening,
    };
    Form {
        stiffness: growth(numbers[0], numbers[1]),
        damping: growth(numbers[2], numbers[3]),
        memory: Memory::new(numbers[4], numbers[5]),
        transport: numbers[6],
        ..form
    }
}
