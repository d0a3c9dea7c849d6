//! The contact law of the paper: a damped normal spring, a damped and capped tangential one.

/// Stiffnesses and damping coefficients of a contact, in units of k_n and √(m k_n).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactLaw {
    /// k_n.
    pub normal_stiffness: f64,
    /// k_t.
    pub tangential_stiffness: f64,
    /// η_n.
    pub normal_damping: f64,
    /// η_t.
    pub tangential_damping: f64,
}

/// What a contact remembers and exerts.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ContactState {
    /// u, tangential displacement accumulated while the contact sticks.
    pub spring: f64,
    /// Normal force, positive in compression.
    pub normal_force: f64,
    /// Tangential force on the first body along t = (−n_y, n_x).
    pub tangential_force: f64,
}

/// What moves a contact tangentially during one time step.
#[derive(Debug, Clone, Copy)]
pub struct TangentialStep {
    /// v_t, surface velocity of the first body relative to the second along t.
    pub velocity: f64,
    /// Time step.
    pub time_step: f64,
    /// Friction coefficient of the contact.
    pub friction: f64,
}

impl ContactLaw {
    /// h_n = k_n Δ − η_n v_n of an overlap Δ and a normal velocity v_n, positive when separating
    /// (paper, "Numerical results").
    ///
    /// ```
    /// use tristack::dem::ContactLaw;
    /// let law = ContactLaw {
    ///     normal_stiffness: 1.0,
    ///     tangential_stiffness: 0.4,
    ///     normal_damping: 0.25,
    ///     tangential_damping: 0.0,
    /// };
    /// assert_eq!(law.normal_force(0.5, -1.0), 0.75);
    /// ```
    pub fn normal_force(&self, overlap: f64, separation_speed: f64) -> f64 {
        self.normal_stiffness * overlap - self.normal_damping * separation_speed
    }

    /// Advances the tangential spring by one step: h_t = −k_t u − η_t v_t, capped at μ |f_n|; the spring
    /// does not grow while the contact slides (paper, "Numerical results").
    pub fn advance(&self, state: &mut ContactState, normal_force: f64, step: TangentialStep) {
        let stretched = state.spring + step.velocity * step.time_step;
        let trial =
            -(self.tangential_stiffness * stretched) - self.tangential_damping * step.velocity;
        let limit = step.friction * normal_force.abs();
        if trial.abs() < limit {
            state.spring = stretched;
            state.tangential_force = trial;
        } else {
            state.tangential_force = if trial < 0.0 { -limit } else { limit };
        }
        state.normal_force = normal_force;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAW: ContactLaw = ContactLaw {
        normal_stiffness: 1.0,
        tangential_stiffness: 0.4,
        normal_damping: 0.2,
        tangential_damping: 0.1,
    };

    fn step(velocity: f64) -> TangentialStep {
        TangentialStep {
            velocity,
            time_step: 0.1,
            friction: 0.5,
        }
    }

    #[test]
    fn normal_force_is_the_negative_slope_of_its_elastic_energy() {
        let energy = |overlap: f64| 0.5 * LAW.normal_stiffness * overlap * overlap;
        let (overlap, width) = (0.3, 1e-3);
        let slope = (energy(overlap + width) - energy(overlap - width)) / (2.0 * width);
        assert!((LAW.normal_force(overlap, 0.0) - slope).abs() < 1e-12);
    }

    #[test]
    fn sticking_contact_stores_the_displacement() {
        let mut state = ContactState::default();
        LAW.advance(&mut state, 1.0, step(0.5));
        assert_eq!(state.spring, 0.05);
        assert!((state.tangential_force + 0.4 * 0.05 + 0.1 * 0.5).abs() < 1e-17);
    }

    #[test]
    fn sliding_contact_is_capped_and_its_spring_frozen() {
        let mut state = ContactState {
            spring: 2.0,
            ..ContactState::default()
        };
        LAW.advance(&mut state, 1.0, step(0.5));
        assert_eq!(state.spring, 2.0);
        assert_eq!(state.tangential_force, -0.5);
    }

    #[test]
    fn cap_opposes_the_spring_in_both_directions() {
        let mut state = ContactState {
            spring: -2.0,
            ..ContactState::default()
        };
        LAW.advance(&mut state, 1.0, step(-0.5));
        assert_eq!(state.tangential_force, 0.5);
    }
}
