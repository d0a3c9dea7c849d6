//! Every constant of the printed formulas.

use std::f64::consts::PI;

const SQRT_3: f64 = 1.732_050_807_568_877_2;

macro_rules! constants {
    ($($name:ident = $value:expr;)*) => {
        /// The paper as printed: the constants of its formulas and the numbers of its text, each of which can
        /// be changed. The methods evaluate the formulas with them, misprints included.
        #[derive(Debug, Clone, PartialEq)]
        pub struct PaperTheory {
            $(pub(crate) $name: f64,)*
        }

        impl PaperTheory {
            /// The names of all constants.
            pub const NAMES: &'static [&'static str] = &[$(stringify!($name)),*];

            /// Returns everything as it stands in the paper.
            pub fn printed() -> Self {
                Self { $($name: $value),* }
            }

            /// Returns the value of the constant of that name; `None` if there is none.
            pub fn constant(&self, name: &str) -> Option<f64> {
                match name {
                    $(stringify!($name) => Some(self.$name),)*
                    _ => None,
                }
            }

            /// Returns the constant of that name for changing it; `None` if there is none.
            pub fn constant_mut(&mut self, name: &str) -> Option<&mut f64> {
                match name {
                    $(stringify!($name) => Some(&mut self.$name),)*
                    _ => None,
                }
            }
        }
    };
}

constants! {
    mass_factor = PI; // π in m = π ρ r² l.
    stack_weights = 3.0; // 3 in f + 3 m g = 2 d.
    floor_contacts = 2.0; // 2 in f + 3 m g = 2 d.
    torque_ratio = 1.0; // Factor of e in b − e = 0, Eqs. (1) and (S21).
    floor_share = 1.0; // 1 in b (t_x + 1), Eqs. (2) and (S22).
    pair_contacts = 2.0; // 2 in 2 a n_y + 2 b t_y, Eqs. (3) and (S23).
    upper_weights = 1.0; // Factor of m g in Eqs. (3) and (S23).
    tangent_sign = -1.0; // Sign in t = (n_y, −n_x).
    rigid_normal_x = -0.5; // n_x = −1/2 of rigid cylinders.
    rigid_normal_y = SQRT_3 / 2.0; // n_y = √3/2 of rigid cylinders.
    rigid_tangent_x = SQRT_3 / 2.0; // t_x = √3/2 of rigid cylinders.
    rigid_tangent_y = 0.5; // t_y = 1/2 of rigid cylinders.
    critical_friction = 2.0 - SQRT_3; // μ_c = 2 − √3.
    critical_friction_decimal = 0.268; // μ_c ≃ 0.268.
    rigid_load_weights = 3.0; // 3 in d = (f + 3 m g)/2 of rigid cylinders.
    rigid_shear_weights = 1.0; // 1 in e = μ_c (f + m g)/2.
    rigid_friction_weight = 3.0; // 3 in 3μ − μ_c, Eq. (4).
    rigid_threshold = 3.0; // 3 in μ_c/3, Eq. (4).

    overlap_diameters = 2.0; // 2 in Δ = 2r − r_ij.
    normal_damping = 1.0; // Factor of η_n v in h_n = k_n Δ − η_n v.
    tangential_damping = 1.0; // Factor of η_t v in h_t = −k_t u − η_t v.
    pair_tangent_sign = -1.0; // Sign of the first component of t_ij = (−y_ij, x_ij)/r_ij.
    spin_arm = 1.0; // Factor of r (ω_i + ω_j) in the tangential velocity.
    // Direction of the capped tangential force: 0 against v_t (as printed), 1 along h_t.
    cap_along_spring = 0.0;
    // Friction that caps the force between cylinders: 0 μ of the floor (as printed), 1 μ_d.
    cap_of_cylinders = 0.0;
    stick_limit = 1.0; // Part of the cap below which the spring grows: |h_t| < μ |f_n|.
    arm_order = 2.0; // Order in the displacements of the torque that a changed arm adds.

    scaling_below = 1.0; // Exponent of ε in the correction to f₀ for μ < μ_c, Eq. (5).
    scaling_at = 0.5; // Exponent of 1/ε at μ_c, Eq. (5).
    scaling_above = 1.0; // Exponent of 1/ε for μ > μ_c, Eq. (5).
    epsilon_factor = 1.0; // Factor in ε = m g/(k_n r), Eq. (6).
    load_factor = 2.0; // 2 in (f + 3 m g)/(m g) = 2 z/(ε r), Eq. (7).
    lowest_displacement = 1.5; // 3/2 in z ≥ 3 ε r/2.
    cross_coefficient = 2.0 * SQRT_3; // 2√3 in 𝒟, Eqs. (9) and (E9).
    compliance_factor = 1.0; // Factor of κ in ℰ, Eqs. (10) and (E9).
    stiff_offset_power = -1.0; // Exponent in μ_c⁻¹ in z⋆, Eq. (12).
    quintic_constant_order = 4.0; // Exponent of ε in the constant term of the quintic, Eq. (11).
    // 0 if the constant term of the quintic is bare (as printed), 1 if it has a coefficient c₀.
    quintic_constant_scaled = 0.0;
    balancing_superscript = 1.0; // Superscript of the coefficient said to balance z⁵ at μ_c.
    larger_exponent = 0.5; // β = 1/2 at μ_c.
    smaller_exponent = 1.0; // β = 1 at μ_c.
    critical_compliance = 4.0; // 4 in z = r √(ε/(μ_c (1 + 4κμ_c))).
    small_root_factor = 4.0; // 4 in z = ε r/(4μ_c).
    naive_factor = 1.0; // Factor of ε r in z = μ_c ε r/(μ_c − μ), Eq. (13).
    remainder_order = 2.0; // Order of the remainder of Eq. (14) away from μ_c.
    remainder_order_at_transition = 2.0; // Order of the remainder of Eq. (14) at μ_c.
    branch_slope = 1.0; // Factor of μ/μ_c in Φ = F(μ, 1 − μ/μ_c), Eq. (15).
    cross_term = 1.0; // Factor of α D E in F, Eqs. (16) and (E10).
    discriminant_factor = 4.0; // 4 under the root of Eq. (17).
    limit_slope = 1.0; // Factor of μ/μ_c in lim α, Eq. (E12).

    slip_rotation = 1.0; // Factor of μ κ z in r θ = μκz − y, Eq. (E1).
    relative_slip = 2.0; // 2 in 2μκz − y, Eqs. (E2) to (E5).
    shear_direction = SQRT_3; // √3 in x + √3 y, Eqs. (E2) to (E5).
    weight_term_power = 3.0; // Exponent of r in ε r³ (x + √3y)², Eqs. (E4) and (E5).
    sum_factor = 1.0; // Factor of √3r − x in the brace of Eq. (E6).
    conjugate_factor = 1.0; // Factor of √3r − x in the brace of Eq. (E7).
    slope_power = 1.0; // Exponent of the fraction [(1−α)² − μ²]/[2μ(1−α)] in Eq. (E8).
    slope_factor = 2.0; // 2 in that fraction.

    damping_factor = 2.0; // 2 in η = −2 ln e_r √(…), Eqs. (S1) and (S2).
    damping_mass = 1.0; // Mass under the root of Eqs. (S1) and (S2), in m.
    restitution = 0.7; // e_r = 0.7.
    upper_height = 1.0; // 1 in (1 + √3) r, Eq. (S4).
    sinking_sign = -1.0; // Sign of δ₁₁ in δ₁, Eq. (S3), and in δ₁₂, Eq. (S8).
    rise_factor = SQRT_3; // √3 in √3 r + δ₂₁ − δ₁₁, Eqs. (S5) to (S7), (S17) and (S18).
    pair_rotation_sign = -1.0; // Sign of r θ in b, Eqs. (S10), (S12) and (S18).
    floor_rotation_sign = 1.0; // Sign of r θ in e, Eqs. (S13), (S16) and (S20).
    // Sign of the spring forces a and d, Eqs. (S9), (S11), (S14), (S15), (S17) and (S19).
    overlap_sign = 1.0;
    explicit_radius_power = 0.0; // Exponent of r in front of √3 δ₂₂ + δ₁₁ − δ₂₁, Eq. (S18).

    stiffness_ratio = 2.5; // κ = k_n/k_t = 2.5.
    cylinder_friction = 0.7; // μ_d = 0.7.
    lowest_stiffness = 1e2; // Lowest k_n r/(m g), 10².
    highest_stiffness = 1e4; // Highest k_n r/(m g), 10⁴.
    compression_speed = 1e-6; // Speed of the compressing wall, in r √(k_n/m).
    time_step = 1e-3; // Time step, in √(m/k_n).

    inward_friction = 0.8; // μ ≳ 0.8, from where on y < 0.
    // μ ≳ 0.58, from where on the wall reaches cylinder 2 at k_n r/(m g) = 10².
    wall_contact_friction = 0.58;
    // μ ≳ 0.58, from where on the perturbative analysis is said to break down.
    breakdown_friction = 0.58;

    elastomer_modulus = 1e6; // E of an elastomer, in Pa.
    elastomer_density = 1e3; // ρ of an elastomer, in kg/m³.
    elastomer_length = 1e-2; // L, in m.
    elastomer_epsilon = 1e-4; // ε of an elastomer.
    elastomer_force = 1e2; // Yield force of an elastomer, in N.
    estimate_mass = 1e-3; // Mass of the estimates, in kg.
    wood_force = 1e5; // Yield force of wood, in N.
    movie_radius = 0.020; // Radius of the cylinders in the movies, in m.
    movie_width = 0.040; // Width of the cylinders in the movies, in m.
    movie_mass = 0.0219; // Mass of the cylinders in the movies, in kg.
}

impl PaperTheory {
    /// Returns a copy with one constant changed; `None` if there is none of that name.
    pub fn with(&self, name: &str, value: f64) -> Option<Self> {
        let mut changed = self.clone();
        *changed.constant_mut(name)? = value;
        Some(changed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_is_a_constant_of_its_own() {
        let printed = PaperTheory::printed();
        for name in PaperTheory::NAMES {
            let changed = printed.with(name, 123.0).expect("a constant");
            assert_ne!(changed, printed, "{name}");
            assert_eq!(changed.constant(name), Some(123.0));
        }
        assert_eq!(printed.with("no_such_constant", 1.0), None);
        assert_eq!(SQRT_3, 3f64.sqrt());
    }
}
