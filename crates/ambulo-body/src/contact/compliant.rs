//! Compliant contact of a sphere and a plane: Hertz spring, Hunt-Crossley damping, friction smoothed over the slip
//! speed.
//!
//!   k = E^(2/3) / 2
//!   F_h = 4/3 k √(R k) (d² + ε)^(3/4)
//!   F_n = F_h (1 + 3/2 c d') · (tanh(b_v (d' + 1/(3/2 c))) + 1)/2 · (tanh(b_d d) + 1)/2
//!   F_t = F_n [ min(v/v_t, 1) (μ_d + 2 (μ_s - μ_d)/(1 + (v/v_t)²)) + μ_v v ]        against the slip;
//!   without the corner at v_t:
//!   F_t = F_n [ μ_d v/√(v² + v_t²) + μ_v v ]
//!
//! | code                  | symbol | unit   | meaning                                                           |
//! | `stiffness`           | E      | N/m²   | plane-strain modulus                                              |
//! | `dissipation`         | c      | s/m    | 3/2 c d' is the ratio of damping to spring force                  |
//! | `static_friction`     | μ_s    | 1      | reached at v = v_t                                                |
//! | `dynamic_friction`    | μ_d    | 1      | at slip far above v_t                                             |
//! | `viscous_friction`    | μ_v    | s/m    | grows with slip                                                   |
//! | `transition_velocity` | v_t    | m/s    | below it, friction falls with slip to zero                        |
//! | `depth_offset`        | ε      | m²     | smooths the spring at d = 0                                       |
//! | `depth_slope`         | b_d    | 1/m    | how steeply the force rises with depth                            |
//! | `rate_slope`          | b_v    | s/m    | how steeply it falls when the surfaces part faster than 1/(3/2 c) |
//! | `radius`              | R      | m      | of the sphere                                                     |
//! | `depth`, `depth_rate` | d, d'  | m, m/s | overlap and its growth                                            |
//! | `slip`                | v      | m/s    | tangential velocity of the surface of the sphere on the plane     |
//!
//! As published, the law gives a small force before the surfaces meet, because tanh(b_d d) is not -1 for d < 0; a small
//! pull while they part fast; and friction with √(v² + ε) in place of v. With [`Onset::AtTouch`], the force is zero
//! unless d > 0, and never negative. The force therefore jumps at d = 0 by half of F_h(0), which is F_h without ε at
//! 3.2 mm: 7.5 N for [`HuntCrossley::FALISSE_2022`] and R = 32 mm. With ε = 0 there is no jump. [`Onset::Published`] is
//! the law as published.
//!
//! Source: opensim-core `SmoothSphereHalfSpaceForce.h`; simbody `SmoothSphereHalfSpaceForce.cpp`; 3dpredictsim
//! `Contact/HCContactModel.m`. Each set of parameters names its own file.
//! Cost: constant.
//! Not handled: radii that change over the contact; load sharing between spheres.
//! Pinned by: tests/contact_geometry.rs

use crate::numerics::elementary;
use crate::spatial::Vec3;
use std::f64::consts::SQRT_2;

/// Parameters of the Hunt-Crossley contact law; the module describes each.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HuntCrossley {
    /// Plane-strain modulus E [N/m²].
    pub stiffness: f64,
    /// c [s/m].
    pub dissipation: f64,
    /// μ_s.
    pub static_friction: f64,
    /// μ_d.
    pub dynamic_friction: f64,
    /// μ_v [s/m].
    pub viscous_friction: f64,
    /// v_t [m/s].
    pub transition_velocity: f64,
    /// ε [m²].
    pub depth_offset: f64,
    /// b_d [1/m].
    pub depth_slope: f64,
    /// b_v [s/m].
    pub rate_slope: f64,
    /// Dry friction against slip speed.
    pub friction_curve: FrictionCurve,
    /// Distance at which the force begins.
    pub onset: Onset,
}

/// Distance at which the force of a contact begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Onset {
    /// The force begins at contact of the surfaces and never pulls.
    #[default]
    AtTouch,
    /// As published: smoothly, before the surfaces meet, with a small pull while they part fast, and √(v² + ε) as slip
    /// speed.
    Published,
}

/// Dry friction as a function of the slip speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FrictionCurve {
    /// As published, with a corner at v_t.
    #[default]
    Stribeck,
    /// v/√(v² + v_t²): smooth at every slip speed, as optimisation needs; μ_s is not used.
    Smooth,
}

/// A parameter out of range.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{parameter} is {found} {unit}; expected a finite number, {least}")]
pub struct HuntCrossleyError {
    parameter: &'static str,
    found: f64,
    unit: &'static str,
    least: &'static str,
}

impl HuntCrossley {
    /// opencap-processing `Moco/models/LaiArnoldModified2017_contacts.osim` and PredSim `Subjects/Falisse_et_al_2022`:
    /// six spheres per foot (four on the calcaneus, two on the toes) of 32 mm.
    pub const FALISSE_2022: HuntCrossley = HuntCrossley {
        stiffness: 1e6,
        dissipation: 2.0,
        static_friction: 0.8,
        dynamic_friction: 0.8,
        viscous_friction: 0.5,
        transition_velocity: 0.2,
        // Defaults of the class in opensim-core.
        depth_offset: 1e-5,
        depth_slope: 300.0,
        rate_slope: 50.0,
        friction_curve: FrictionCurve::Stribeck,
        onset: Onset::AtTouch,
    };
    /// opensim-core Moco `example2DWalking/2D_gait.osim`: two spheres per foot, 35 mm at the heel and 15 mm at the
    /// forefoot.
    pub const MOCO_2D_GAIT: HuntCrossley = HuntCrossley { stiffness: 3_067_776.0, ..HuntCrossley::FALISSE_2022 };
    /// Soft shoes: stiffness as OpenSim Moco's `2D_gait.osim`, dissipation 2 s/m as there and in Falisse 2022; friction
    /// 0.6. A creep speed of 13 mm/s at full friction is ours; it is much slower than theirs (0.2 m/s), so that a foot
    /// in stance stays in place.
    pub const SOFT_SHOES: HuntCrossley = HuntCrossley {
        static_friction: 0.6,
        dynamic_friction: 0.6,
        viscous_friction: 0.0,
        transition_velocity: 0.013,
        depth_offset: 0.0,
        friction_curve: FrictionCurve::Smooth,
        ..HuntCrossley::MOCO_2D_GAIT
    };
    /// opensim-models `WalkerModel.osim`: spheres of 50 mm.
    pub const WALKER_MODEL: HuntCrossley =
        HuntCrossley { dissipation: 1.0, dynamic_friction: 0.4, viscous_friction: 0.4, ..HuntCrossley::FALISSE_2022 };
    /// SCONE `Human0914.osim` and `H0914M_osim3.osim`: heel and toe, 30 mm. A comment in the file gives a dissipation
    /// of 0.3; the file sets 1.
    pub const SCONE_HUMAN_0914: HuntCrossley = HuntCrossley {
        stiffness: 2e6,
        dissipation: 1.0,
        static_friction: 0.9,
        dynamic_friction: 0.8,
        viscous_friction: 0.6,
        transition_velocity: 0.1,
        ..HuntCrossley::FALISSE_2022
    };

    /// Returns the parameters if all are in range.
    ///
    /// # Errors
    /// Reports the first parameter that is negative or not finite; the transition velocity must be above zero.
    pub fn checked(self) -> Result<HuntCrossley, HuntCrossleyError> {
        let all = [
            ("the stiffness", self.stiffness, "N/m²"),
            ("the dissipation", self.dissipation, "s/m"),
            ("the static friction", self.static_friction, ""),
            ("the dynamic friction", self.dynamic_friction, ""),
            ("the viscous friction", self.viscous_friction, "s/m"),
            ("the depth offset", self.depth_offset, "m²"),
            ("the depth slope", self.depth_slope, "1/m"),
            ("the rate slope", self.rate_slope, "s/m"),
        ];
        for (parameter, found, unit) in all {
            if !(found >= 0.0 && found.is_finite()) {
                return Err(HuntCrossleyError { parameter, found, unit, least: "zero or more" });
            }
        }
        let found = self.transition_velocity;
        if found > 0.0 && found.is_finite() {
            return Ok(self);
        }
        Err(HuntCrossleyError { parameter: "the transition velocity", found, unit: "m/s", least: "above zero" })
    }

    /// Normal force [N] and friction [N] on a sphere of this radius [m] whose overlap with the plane is
    /// `depth` [m], growing by `depth_rate` [m/s], and whose surface moves along the plane with `slip` [m/s].
    #[inline]
    #[must_use]
    pub fn force(&self, radius: f64, depth: f64, depth_rate: f64, slip: Vec3) -> (f64, Vec3) {
        let normal_force = self.normal_force(radius, depth, depth_rate);
        let speed = self.slip_speed(slip);
        if normal_force.abs() <= 0.0 || speed <= 0.0 {
            return (normal_force, Vec3::zeros());
        }
        (normal_force, slip * (-normal_force * self.friction_per_slip(speed)[0]))
    }

    /// Slip speed as the friction takes it [m/s].
    #[inline]
    fn slip_speed(&self, slip: Vec3) -> f64 {
        match self.onset {
            Onset::AtTouch => slip.norm(),
            Onset::Published => (slip.norm_squared() + self.depth_offset).sqrt(),
        }
    }

    #[inline]
    fn normal_force(&self, radius: f64, depth: f64, depth_rate: f64) -> f64 {
        self.normal_with_slopes(radius, depth, depth_rate)[0]
    }

    /// The normal force, and its derivatives by depth and by rate of depth.
    #[inline]
    fn normal_with_slopes(&self, radius: f64, depth: f64, depth_rate: f64) -> [f64; 3] {
        let ends_at_touch = self.onset == Onset::AtTouch;
        if ends_at_touch && depth <= 0.0 {
            return [0.0; 3];
        }
        // 4/3 k √(R k) (d²)^(3/4) with k = ½ E^(2/3): k √k = E/√8, and no power but roots is left.
        let square = depth * depth + self.depth_offset;
        let root = square.sqrt();
        let hertz = SQRT_2 / 3.0 * self.stiffness * radius.sqrt() * root * root.sqrt();
        let hertz_slope = hertz * 1.5 * depth / square;
        let c = 1.5 * self.dissipation;
        let damping = 1.0 + c * depth_rate;
        // Without dissipation, the force does not vanish at any speed of separation.
        let (separation, separation_slope) =
            if c > 0.0 { step(self.rate_slope * (depth_rate + 1.0 / c)) } else { (1.0, 0.0) };
        let (rise, rise_slope) = step(self.depth_slope * depth);
        let force = hertz * damping * separation * rise;
        if ends_at_touch && force <= 0.0 {
            return [0.0; 3];
        }
        let by_depth = damping * separation * (hertz_slope * rise + hertz * rise_slope * self.depth_slope);
        let by_rate = hertz * rise * (c * separation + damping * separation_slope * self.rate_slope);
        [force, by_depth, by_rate]
    }

    /// |F_t| / (F_n v), the friction coefficient over the slip speed v [s/m], and its derivative by v over v [s³/m³].
    #[inline]
    fn friction_per_slip(&self, speed: f64) -> [f64; 2] {
        let v_t = self.transition_velocity;
        let v = speed / v_t;
        let (mu_s, mu_d) = (self.static_friction, self.dynamic_friction);
        let (dry, slope) = match self.friction_curve {
            FrictionCurve::Stribeck => {
                let fading = 2.0 * (mu_s - mu_d) / (1.0 + v * v);
                let fading_slope = -2.0 * fading / (1.0 + v * v);
                if v <= 1.0 {
                    (mu_d + fading, fading_slope)
                } else {
                    ((mu_d + fading) / v, (fading_slope - (mu_d + fading) / (v * v)) / v)
                }
            }
            FrictionCurve::Smooth => {
                let root = (1.0 + v * v).sqrt();
                (mu_d / root, -mu_d / (root * root * root))
            }
        };
        [dry / v_t + self.viscous_friction, slope / (v_t * v_t * v_t)]
    }

    /// Force on the sphere as from [`HuntCrossley::force`], with its derivatives. They are exact except at the corner
    /// of [`FrictionCurve::Stribeck`]. The normal of the plane is +y.
    #[inline]
    #[must_use]
    pub fn force_with_slopes(&self, radius: f64, depth: f64, depth_rate: f64, slip: Vec3) -> ContactSlopes {
        let [normal, by_depth, by_rate] = self.normal_with_slopes(radius, depth, depth_rate);
        let slip = Vec3::new(slip.x, 0.0, slip.z);
        let [ratio, bend] = self.friction_per_slip(self.slip_speed(slip));
        let per_newton = Vec3::y() - slip * ratio;
        let by_slip = [Vec3::x(), Vec3::z()].map(|e| (e * ratio + slip * (bend * slip.dot(&e))) * -normal);
        ContactSlopes {
            force: per_newton * normal,
            by_depth: per_newton * by_depth,
            by_rate: per_newton * by_rate,
            by_slip,
        }
    }
}

/// Force of a contact and its derivatives; y is up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactSlopes {
    /// Force on the sphere [N].
    pub force: Vec3,
    /// Derivative by depth [N/m].
    pub by_depth: Vec3,
    /// Derivative by rate of depth [N.s/m].
    pub by_rate: Vec3,
    /// Derivatives by slip along x and along z [N.s/m].
    pub by_slip: [Vec3; 2],
}

/// A smooth step from 0 to 1 around x = 0, with its derivative.
#[inline]
fn step(x: f64) -> (f64, f64) {
    let tanh = elementary::tanh(x);
    (0.5 * tanh + 0.5, 0.5 - 0.5 * tanh * tanh)
}
