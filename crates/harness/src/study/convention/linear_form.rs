//! The linear form in which the law of a sticking contact is fitted to its rows.

use super::beside::fit_beside;
use super::contact_frame::{ContactRow, as_long_as};
use super::regression::{Measured, deviations, fit_rows};
use super::shape::{Growth, Memory};

/// Fraction of Coulomb's limit up to which rows count as sticking.
const CERTAINLY_STICKING: f64 = 0.5;

/// Indices of the coefficients of the linear form, and their numbers without and with terms of third order.
pub const SPRING: usize = 0;
pub const SPRING_SPIN: usize = 1;
pub const SPRING_SPIN_OVERLAP: usize = 2;
pub const DAMPING: usize = 3;
pub const DAMPING_SPIN_OVERLAP: usize = 4;
const COEFFICIENTS: usize = 5;
pub const SPRING_SPIN_CUBED: usize = 5;
const COEFFICIENTS_OF_THIRD_ORDER: usize = 7;
/// Change of an exponent over which the slope of the forces is taken.
const EXPONENT_STEP: f64 = 1e-3;
/// The same for what a turning contact does to its spring, on which the forces depend almost linearly.
const TURNING_STEP: f64 = 1e-2;
/// Steps of Gauss–Newton, in models that are almost linear.
const ROUNDS: usize = 3;

/// What a law has beyond its coefficients.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Form {
    /// Growth of the stiffness.
    pub stiffness: Growth,
    /// Growth of the damping.
    pub damping: Growth,
    /// What the spring remembers.
    pub memory: Memory,
    /// Whether the motion of a surface has a term of third order in the angle by which it turns in a step.
    pub third_order: bool,
    /// Change of the spring's length in units of 1 − cos dψ, when the contact turns by dψ.
    pub transport: f64,
    /// Share of its normal component that a spring keeps when the contact turns under it: 0 for a spring that follows
    /// the contact, 1 for a vector that nothing turns. The transport of the latter is −1: its tangential component is
    /// projected, and gains what the normal component turns into.
    pub left_behind: f64,
}

impl Form {
    /// Constant coefficients, a surface that moves by R ω dt, a spring that keeps its length.
    pub const PLAIN: Self = Self {
        stiffness: Growth::NONE,
        damping: Growth::NONE,
        memory: Memory::DISPLACEMENT,
        third_order: false,
        transport: 0.0,
        left_behind: 0.0,
    };

    /// The same with a spring that nothing turns.
    pub fn fixed(self) -> Self {
        Self {
            transport: -1.0,
            left_behind: 1.0,
            ..self
        }
    }

    /// The same with this transport and this share left behind.
    pub fn with_turning(self, [transport, left_behind]: [Measured; 2]) -> Self {
        Self {
            transport: transport.value,
            left_behind: left_behind.value,
            ..self
        }
    }

    fn coefficients(self) -> usize {
        match self.third_order {
            true => COEFFICIENTS_OF_THIRD_ORDER,
            false => COEFFICIENTS,
        }
    }

    /// Number of coefficients that are fitted to `motions`, including the initial force of each spring.
    pub fn columns(self, motions: &[&[ContactRow]]) -> usize {
        self.coefficients() + motions.len()
    }

    /// The coefficients that fit `motions`, and the initial forces of their springs; `radius` is R at vanishing overlap.
    pub fn fit(self, motions: &[&[ContactRow]], radius: f64) -> Vec<Measured> {
        fit_rows(&self.terms(motions, radius), self.columns(motions))
    }

    /// The deviations that the best fit leaves in the forces ([`deviations`]).
    pub fn deviations(self, motions: &[&[ContactRow]], radius: f64) -> Option<(f64, f64)> {
        deviations(&self.terms(motions, radius), self.columns(motions))
    }

    /// The transport that fits best, together with all coefficients. Rounding accumulates in a spring, so that a
    /// whole motion counts as one observation in the uncertainty.
    pub fn fit_transport(self, motions: &[&[ContactRow]], radius: f64) -> Measured {
        let with = |[transport]: [f64; 1]| Self { transport, ..self }.terms(motions, radius);
        let [found] = fit_beside([self.transport], 1.0, ROUNDS, self.columns(motions), with).others;
        let rows: usize = motions.iter().map(|rows| rows.len()).sum();
        let alike = (rows as f64 / motions.len() as f64).sqrt();
        Measured::new(found.value, found.uncertainty * alike)
    }

    /// The transport and the share left behind that fit best, together with all coefficients, near those of the form.
    /// A whole motion counts as one observation in their uncertainties.
    pub fn fit_turning(self, motions: &[&[ContactRow]], radius: f64) -> [Measured; 2] {
        let with = |[transport, left_behind]: [f64; 2]| {
            let form = Self {
                transport,
                left_behind,
                ..self
            };
            form.terms(motions, radius)
        };
        let start = [self.transport, self.left_behind];
        let found = fit_beside(start, TURNING_STEP, ROUNDS, self.columns(motions), with).others;
        let rows: usize = motions.iter().map(|rows| rows.len()).sum();
        let alike = (rows as f64 / motions.len() as f64).sqrt();
        found.map(|own| Measured::new(own.value, own.uncertainty * alike))
    }

    /// The exponent that fits best, together with all coefficients, near that of the form.
    pub fn fit_exponent(self, motions: &[&[ContactRow]], radius: f64) -> Measured {
        let with = |[exponent]: [f64; 1]| self.with_exponent(exponent).terms(motions, radius);
        let start = [self.stiffness.exponent];
        let [found] = fit_beside(start, EXPONENT_STEP, ROUNDS, self.columns(motions), with).others;
        found
    }

    /// The same with another exponent of the stiffness.
    pub fn with_exponent(self, exponent: f64) -> Self {
        let stiffness = Growth {
            exponent,
            ..self.stiffness
        };
        Self { stiffness, ..self }
    }

    /// The factor with which a displacement enters what the spring remembers.
    pub fn remembered(self, row: &ContactRow) -> f64 {
        libm::pow(self.stiffness.at(row.overlap), self.memory.force_share)
    }

    /// The factor with which what the spring remembers enters its force, apart from k_t at an overlap of 1.
    pub fn exerted(self, row: &ContactRow) -> f64 {
        let share = 1.0 - self.memory.force_share;
        libm::pow(self.stiffness.at(row.overlap), share)
    }

    /// The factor by which what the spring remembers changes between two rows.
    fn carried(self, before: &ContactRow, row: &ContactRow) -> f64 {
        self.memory.rescaled(before, row) * carried(before, row, self.transport)
    }

    /// Tangential and normal components of what the spring remembers, after the contact has turned between two rows.
    pub fn turned(
        self,
        [along, lift]: [f64; 2],
        before: &ContactRow,
        row: &ContactRow,
    ) -> [f64; 2] {
        let factor = self.carried(before, row);
        if self.left_behind == 0.0 {
            return [along * factor, 0.0];
        }
        let sine = self.memory.rescaled(before, row) * sine(row);
        let cosine = self.memory.rescaled(before, row) * (1.0 - versine(before, row));
        [
            along * factor - self.left_behind * sine * lift,
            cosine * lift + sine * along,
        ]
    }

    /// Tangential and normal components of a spring of length 1 before the growth in the first row. It has that
    /// length from the step before, and its contact has turned once since.
    pub fn begun(self, first: &ContactRow) -> [f64; 2] {
        [1.0, self.left_behind * sine(first)]
    }

    /// Terms and force of every row.
    pub fn terms(self, motions: &[&[ContactRow]], radius: f64) -> Vec<(Vec<f64>, f64)> {
        let coefficients = self.coefficients();
        let mut rows = Vec::new();
        for (index, motion) in motions.iter().enumerate() {
            let mut springs = [[0.0; 2]; 5];
            let mut initial = motion.first().map_or([1.0, 0.0], |row| self.begun(row));
            let mut before: Option<&ContactRow> = None;
            for row in *motion {
                let turned = |spring: [f64; 2]| {
                    before.map_or(spring, |before| self.turned(spring, before, row))
                };
                let speeds = speeds(row);
                let entering = row.time_step * self.remembered(row);
                for (spring, speed) in springs.iter_mut().zip(speeds) {
                    let [along, lift] = turned(*spring);
                    *spring = [along - speed * entering, lift];
                }
                initial = turned(initial);
                let stiffer = self.exerted(row);
                let damped = self.damping.at(row.overlap);
                let [across, spin, spin_overlap, cubed, cubed_overlap] =
                    springs.map(|[along, _]| along * stiffer);
                // The contact force itself couples translation and spin. The damping of each cannot be told apart,
                // and belongs to the radius of the torque.
                let damping = -(speeds[0] + radius * speeds[1]) * damped;
                let damping_overlap = -speeds[2] * damped;
                let mut terms = vec![across, spin, spin_overlap, damping, damping_overlap];
                terms.extend([cubed, cubed_overlap]);
                terms.truncate(coefficients);
                terms.resize(coefficients + motions.len(), 0.0);
                terms[coefficients + index] = initial[0] * stiffer;
                rows.push((terms, row.tangential_force));
                before = Some(row);
            }
        }
        rows
    }
}

/// v_t, −ω and −ω δ, whose combination with 1, R(0) and r₁ is w; −ω³ dt² and −ω³ dt² δ.
fn speeds(row: &ContactRow) -> [f64; 5] {
    let (spin, cubed) = (row.spin(), cubed_turns(row) / row.time_step);
    [
        row.tangential_speed,
        -spin,
        -spin * row.overlap,
        -cubed,
        -cubed * row.overlap,
    ]
}

/// Sum of the third powers of the angles by which the two sides turn in a step.
pub fn cubed_turns(row: &ContactRow) -> f64 {
    let [one, other] = row.spins.map(|spin| spin * row.time_step);
    one * one * one + other * other * other
}

/// The first rows, as long as the contact certainly sticks.
pub fn sticking(rows: &[ContactRow]) -> &[ContactRow] {
    as_long_as(rows, |row| {
        let limit = row.friction * row.normal_force;
        row.tangential_force.abs() < CERTAINLY_STICKING * limit
    })
}

/// sin dψ of the step that leads to a row.
fn sine(row: &ContactRow) -> f64 {
    let ([old_x, old_y], [x, y]) = (row.last_normal, row.normal);
    old_x * y - old_y * x
}

/// 1 − cos dψ between two rows.
pub fn versine(before: &ContactRow, row: &ContactRow) -> f64 {
    let apart = [0, 1].map(|axis| row.normal[axis] - before.normal[axis]);
    0.5 * (apart[0] * apart[0] + apart[1] * apart[1])
}

/// The factor by which a change of the normal between two rows changes the length of the spring.
pub fn carried(before: &ContactRow, row: &ContactRow, transport: f64) -> f64 {
    1.0 + transport * versine(before, row)
}
