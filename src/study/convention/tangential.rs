//! The tangential law of a contact that sticks: stiffness, damping, arms, history update.

use super::contact_frame::ContactRow;
use super::growth::exponent;
use super::regression::{Measured, deviations, fit, fit_rows};

/// Fraction of Coulomb's limit up to which rows count as sticking.
const CERTAINLY_STICKING: f64 = 0.5;
/// Rounds in which the transport and the other coefficients are fitted in turn; each gains some two digits.
const ROUNDS: usize = 8;

/// f_t = −k_t u − η_t w, where the spring u grows by w dt a step and w = v_t − R ω, R = r + r₁ δ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TangentialLaw {
    /// k_t.
    pub stiffness: Measured,
    /// η_t.
    pub damping: Measured,
    /// R at vanishing overlap, from the torque.
    pub radius: Measured,
    /// r₁ from the torque.
    pub torque_arm: Measured,
    /// r₁ from the growth of the spring.
    pub kinematic_arm: Measured,
    /// r₁ from the damping.
    pub damping_arm: Measured,
    /// Change of the spring's length in units of 1 − cos dψ, when the contact turns by dψ.
    pub transport: Measured,
}

/// Coefficients of the linear form in which the law is fitted.
const SPRING: usize = 0;
const SPRING_SPIN: usize = 1;
const SPRING_SPIN_OVERLAP: usize = 2;
const DAMPING: usize = 3;
const DAMPING_SPIN_OVERLAP: usize = 4;
const COEFFICIENTS: usize = 5;

impl TangentialLaw {
    /// Fits several gentle motions and, for a pair, one in which the contact turns.
    pub fn read(gentle: &[Vec<ContactRow>], turning: Option<&[ContactRow]>) -> Self {
        let gentle: Vec<&[ContactRow]> = gentle.iter().map(|rows| sticking(rows)).collect();
        let (radius, torque_arm) = arms_of_torque(&gentle);
        let mut law = Self::fitted(&gentle, 0.0, radius, torque_arm);
        if let Some(turning) = turning {
            for _ in 0..ROUNDS {
                let transport = law.fit_transport(sticking(turning));
                law = Self {
                    transport,
                    ..Self::fitted(&gentle, transport.value, radius, torque_arm)
                };
            }
        }
        law
    }

    fn fitted(
        gentle: &[&[ContactRow]],
        transport: f64,
        radius: Measured,
        torque_arm: Measured,
    ) -> Self {
        let found = fit_rows(
            &terms(gentle, transport, radius.value, 0.0),
            COEFFICIENTS + gentle.len(),
        );
        Self {
            stiffness: found[SPRING],
            damping: found[DAMPING],
            radius,
            torque_arm,
            kinematic_arm: found[SPRING_SPIN_OVERLAP].over(found[SPRING]),
            damping_arm: found[DAMPING_SPIN_OVERLAP].over(found[DAMPING]),
            transport: Measured::new(0.0, 0.0),
        }
        .with_common_radius(found[SPRING_SPIN].over(found[SPRING]))
    }

    /// Adds the difference between the radius of the spring and that of the torque, which should be the same, to the
    /// uncertainty of the latter.
    fn with_common_radius(mut self, of_spring: Measured) -> Self {
        let apart = (of_spring.value - self.radius.value).abs();
        self.radius.uncertainty += (apart - of_spring.uncertainty).max(0.0);
        self
    }

    /// w of a row.
    pub fn surface_speed(&self, row: &ContactRow) -> f64 {
        let radius = self.radius.value + self.kinematic_arm.value * row.overlap;
        row.tangential_speed - radius * row.spin
    }

    /// Force of the spring, −k_t u, in a row that sticks.
    pub fn spring_force(&self, row: &ContactRow) -> f64 {
        row.tangential_force + self.damping.value * self.surface_speed(row)
    }

    /// Fits the transport to one motion with a stretched spring, all other coefficients being known, by Gauss–Newton
    /// in the transport and the initial spring.
    fn fit_transport(&self, rows: &[ContactRow]) -> Measured {
        let Some(first) = rows.first() else {
            return Measured::UNKNOWN;
        };
        let (mut initial, mut transport) = (self.spring_force(first), self.transport.value);
        let mut found = Measured::UNKNOWN;
        for _ in 0..ROUNDS {
            let (mut spring, mut by_initial, mut by_transport) = (initial, 1.0, 0.0);
            let mut terms = Vec::new();
            for window in rows.windows(2) {
                let [before, row] = [&window[0], &window[1]];
                let factor = carried(before, row, transport);
                by_transport = by_transport * factor + versine(before, row) * spring;
                by_initial *= factor;
                let growth = self.surface_speed(row) * row.time_step;
                spring = spring * factor - self.stiffness.value * growth;
                terms.push(([by_initial, by_transport], self.spring_force(row) - spring));
            }
            let [start, change] = fit(&terms);
            initial += start.value;
            transport += change.value;
            found = Measured::new(transport, change.uncertainty);
        }
        found
    }
}

/// The exponent with which the stiffness grows with the overlap, if it does.
pub fn growth(gentle: &[Vec<ContactRow>], law: &TangentialLaw) -> Option<Measured> {
    let gentle: Vec<&[ContactRow]> = gentle.iter().map(|rows| sticking(rows)).collect();
    exponent(|p| {
        let rows = terms(&gentle, 0.0, law.radius.value, p);
        deviations(&rows, COEFFICIENTS + gentle.len())
    })
}

/// The linear form of the law: terms and force of every row, the spring of a row being stiffer by the power `exponent` of
/// its overlap.
fn terms(
    gentle: &[&[ContactRow]],
    transport: f64,
    radius: f64,
    exponent: f64,
) -> Vec<(Vec<f64>, f64)> {
    let columns = COEFFICIENTS + gentle.len();
    let mut rows = Vec::new();
    for (index, motion) in gentle.iter().enumerate() {
        let mut growth = [0.0; 3];
        let mut initial = 1.0;
        let mut before: Option<&ContactRow> = None;
        for row in *motion {
            let factor = before.map_or(1.0, |before| carried(before, row, transport));
            let speeds = speeds(row);
            for (sum, speed) in growth.iter_mut().zip(speeds) {
                *sum = *sum * factor - speed * row.time_step;
            }
            initial *= factor;
            let stiffer = libm::pow(row.overlap, exponent);
            let mut terms: Vec<f64> = growth.iter().map(|spring| spring * stiffer).collect();
            // Translation and spin are coupled by the contact force itself; the damping of each cannot
            // be told apart, and belongs to the radius of the torque.
            let [translation, spin, spin_overlap] = speeds;
            terms.push(-(translation + radius * spin));
            terms.push(-spin_overlap);
            terms.resize(columns, 0.0);
            terms[COEFFICIENTS + index] = initial * stiffer;
            rows.push((terms, row.tangential_force));
            before = Some(row);
        }
    }
    rows
}

/// The first rows, as long as the contact certainly sticks.
fn sticking(rows: &[ContactRow]) -> &[ContactRow] {
    let sticks = |row: &ContactRow| {
        let limit = row.friction * row.normal_force;
        row.tangential_force.abs() < CERTAINLY_STICKING * limit
    };
    let end = rows.iter().position(|row| !sticks(row));
    &rows[..end.unwrap_or(rows.len())]
}

/// v_t, −ω and −ω δ, whose combination with 1, R(0) and r₁ is w.
fn speeds(row: &ContactRow) -> [f64; 3] {
    [row.tangential_speed, -row.spin, -row.spin * row.overlap]
}

/// 1 − cos dψ between two rows.
fn versine(before: &ContactRow, row: &ContactRow) -> f64 {
    let apart = [0, 1].map(|axis| row.normal[axis] - before.normal[axis]);
    0.5 * (apart[0] * apart[0] + apart[1] * apart[1])
}

/// The factor by which the spring changes its length between two rows.
pub fn carried(before: &ContactRow, row: &ContactRow, transport: f64) -> f64 {
    1.0 + transport * versine(before, row)
}

/// R at vanishing overlap and r₁ from −M = (R(0) + r₁ δ) f_t, of both bodies where both feel it.
fn arms_of_torque(gentle: &[&[ContactRow]]) -> (Measured, Measured) {
    let mut terms = Vec::new();
    for row in gentle.iter().copied().flatten() {
        let force = row.tangential_force;
        for torque in [row.torque, row.other_torque] {
            if torque != 0.0 {
                terms.push(([force, row.overlap * force], -torque));
            }
        }
    }
    let [radius, arm] = fit(&terms);
    (radius, arm)
}
