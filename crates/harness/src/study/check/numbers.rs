//! The numbers of the twin that a mistake may change.

/// Declares a struct of numbers, each with its right value and its meaning.
macro_rules! numbers {
    ($(#[$doc:meta])* $kind:ident: $($name:ident = $right:expr, $meaning:literal;)*) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub(super) struct $kind {
            $(#[doc = $meaning] pub $name: f64,)*
        }

        impl $kind {
            pub const RIGHT: Self = Self { $($name: $right,)* };

            /// Returns the number called `name`.
            pub fn by_name(&mut self, name: &str) -> Option<&mut f64> {
                match name {
                    $(stringify!($name) => Some(&mut self.$name),)*
                    _ => None,
                }
            }
        }
    };
}

numbers! {
    /// The law of one contact: its coefficients at an overlap of 1, and what may be wrong with it. Without a mistake
    /// factors are 1 and flags are 0.
    OfContact:
    normal_stiffness = 1.0, "k_n.";
    tangential_stiffness = 1.0, "k_t.";
    damping_normal = 0.0, "η_n.";
    damping_tangential = 0.0, "η_t.";
    friction = 0.0, "μ.";
    sliding_friction = 1.0, "Factor on μ of a contact that slides.";
    exists = 1.0, "Factor on both forces.";
    by_diameter = 0.0, "Flag: the normal is the distance of the centres over 2 r, and no unit vector.";
    lever = 1.0, "Radius in torque and surface velocity.";
    exponent = 0.0, "Power of the overlap in the normal spring's force beyond that of the law.";
    damping_exponent = 0.0, "The same in the normal damping.";
    tangential_exponent = 0.0, "The same in the tangential stiffness.";
    tangential_damping_exponent = 0.0, "The same in the tangential damping.";
    spring_growth = 1.0, "Factor on the growth of the tangential spring in a step.";
    spring_kept = 1.0, "Part of the tangential spring that is kept from one step to the next.";
    spin_one = 1.0, "Factor on the spin of the first body in the surface velocity.";
    spin_two = 1.0, "The same of the second body.";
    spin_in_spring = 1.0, "Factor on the spins in the growth of the spring.";
    spin_in_damping = 1.0, "Factor on the spins in the damping.";
    separation_two = 1.0, "Factor on the velocity of the second body along the normal.";
    sliding_one = 1.0, "Factor on the velocity of the first body along the tangent.";
    sliding_two = 1.0, "The same of the second body.";
    torque_one = 1.0, "Factor on the torque on the first body.";
    torque_two = 1.0, "The same of the second body.";
    normal_one = 1.0, "Factor on the normal force on the first body.";
    normal_two = 1.0, "The same of the second body.";
    tangential_one = 1.0, "Factor on the tangential force on the first body.";
    tangential_two = 1.0, "The same of the second body.";
    tangent = 1.0, "Factor on the direction of the tangential force.";
    damping_one = 1.0, "Factor on the normal damping on the first body.";
    damping_two = 1.0, "The same of the second body.";
    spring_one = 1.0, "Factor on the normal spring on the first body.";
    spring_two = 1.0, "The same of the second body.";
    limit_of_spring = 0.0, "Flag: μ times the spring's part of the normal force.";
    limit_of_weight = 0.0, "Flag: μ times m g.";
    limit_signed = 0.0, "Flag: μ n without the absolute value, none where it pulls.";
    keeps_sliding_spring = 0.0, "Flag: the spring grows while the contact slides.";
    clears_sliding_spring = 0.0, "Flag: it is 0 while the contact slides.";
    flips_sliding_spring = 0.0, "Flag: it is that of the force at the limit, with the wrong sign.";
    first_normal = 0.0, "Flag: the normal is that of the moment at which the surfaces have touched.";
    keeps_whole_force = 0.0, "Flag: while the contact slides the spring bears the whole force, damping included.";
    keeps_damping = 0.0, "Flag: while the contact sticks the spring takes up the damping, which so adds up.";
    keeps_open_spring = 0.0, "Flag: it is kept while the contact is open.";
    stretches_open_spring = 0.0, "Flag: it is kept and stretched while the contact is open.";
    stale_spring = 0.0, "Flag: the force is that of the spring before it grows.";
    damps_sliding = 0.0, "Flag: the damping is added to the force at the limit.";
    one_sided = 0.0, "The sign that the force at the limit always has; 0 where it has that of the force.";
    uncapped_damping = 0.0, "Flag: the spring alone is capped, and the damping added.";
    caps_of = 0.0, "The sign of the forces that alone are capped; 0 where all are.";
    limit_before = 0.0, "Flag: μ times the normal force of the step before.";
    damps_approach = 0.0, "Flag: only surfaces that approach are damped along the normal.";
    pulls = 0.0, "Flag: a contact that opens goes on pulling.";
    shares_spring = 0.0, "Flag: all contacts of its kind have one tangential spring.";
    touches = 0.0, "Flag: surfaces that just touch are a contact.";
}

numbers! {
    /// Bodies, integration and loading.
    OfRun:
    mass = 1.0, "m in the acceleration.";
    weight = 1.0, "Factor on the weight.";
    weight_1 = 1.0, "The same of cylinder 1 alone.";
    weight_2 = 1.0, "The same of cylinder 2 alone.";
    weight_3 = 1.0, "The same of cylinder 3 alone.";
    tilt = 0.0, "Horizontal part of gravity.";
    radius = 1.0, "Radius wherever it counts.";
    moment_of_inertia = 0.5, "I.";
    time_step = 0.0, "dt.";
    mass_1 = 1.0, "Factor on m of cylinder 1.";
    push_x = 1.0, "Factor on horizontal forces in the kick.";
    push_y = 1.0, "The same of vertical ones.";
    push_spin = 1.0, "The same of torques.";
    drift = 1.0, "Factor on the change of positions.";
    gravity = 0.0, "g.";
    gravity_in_compression = 1.0, "Factor on the weight in the compression.";
    ramp_steps = 0.0, "Steps of the ramp.";
    rest_steps = 0.0, "Steps of the rest.";
    ramp_shape = 0.0, "0: quintic, 1: linear, 2: 3x² − 2x³, 3: half a cosine, 4: sudden, 5: x², 6: x³, 7: √x, 8: sine; 9 and 10: 1 and 0 over ramp and rest.";
    ramp_ahead = 0.0, "Steps by which the ramp is ahead.";
    unbounded_ramp = 0.0, "Flag: the ramp goes on beyond 1.";
    wall_speed = 0.0, "Speed of the top wall.";
    wall_drift = 1.0, "Factor on the movement of the top wall.";
    wall_per_step = 0.0, "Flag: it moves by its speed in every step.";
    wall_ahead = 0.0, "Steps by which it is ahead of the bodies.";
    wall_from_start = 0.0, "Flag: it starts above the stack as it was before gravity.";
    wall_per_body = 0.0, "Flag: it moves once for every body in a step.";
    wall_from_run = 0.0, "Flag: it has moved since the beginning of the run.";
    wall_presses = 1.0, "Factor on its force on cylinder 1.";
    clears_springs = 0.0, "Flag: the springs are cleared when it starts.";
    clears_velocities = 0.0, "Flag: the bodies are stopped when it starts.";
    euler = 0.0, "Flag: positions move with the velocities of before the kick.";
    mean_velocity = 0.0, "Flag: positions move with the mean of both velocities.";
    accelerates = 0.0, "Flag: positions move on by a dt²/2 in addition.";
    half_kick = 0.0, "Flag: the first kick is a half.";
    kept_forces = 0.0, "Part of the forces of the step before that is left in those of a step.";
    kept_torques = 0.0, "The same of the torques.";
    old_forces = 0.0, "Flag: bodies are moved by the forces of the step before.";
    local_damping = 0.0, "Part of the force that opposes the velocity (Cundall).";
    damps_rest = 0.0, "Flag: that of a body at rest counts as if it moved in the positive direction.";
    twice_at_rows = 0.0, "Flag: the forces are computed twice at the steps of rows, and the springs grow twice.";
    fixed_top = 0.0, "Flag: cylinder 1 cannot move sideways.";
    no_spin = 0.0, "Flag: the cylinders do not turn.";
    one_spin = 0.0, "Flag: only cylinder 1 turns.";
    single_precision = 0.0, "Flag: positions and velocities are kept in single precision.";
}
