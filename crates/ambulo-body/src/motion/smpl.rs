//! Motions of the SMPL family (`.npz` of AMASS: SMPL, SMPL-H, SMPL-X) as skeletons.
//!
//! | array | content |
//! |---|---|
//! | `poses` | one row a frame: a rotation vector of three numbers for each joint [rad], the pelvis first; the first 22 joints are the same in all models |
//! | or `root_orient` (`global_orient`), `pose_body` (`body_pose`) | the same, the pelvis apart |
//! | `trans` (`transl`) | position of the body [m] |
//! | `mocap_framerate` or `mocap_frame_rate`, `frame_rate`, `fps` | frames per second |
//! | `betas` | shape of the body; needs the model's file |
//!
//! Rotations may also be matrices of three by three numbers. The numbers of other representations have no agreed order
//! (quaternions with w first or last, six numbers of two rows or of two columns), so that they are refused by name.
//!
//! A rotation turns the axes of a joint relative to its parent; in the resting pose, a T, all are x to the left, y
//! up, z forward. The file has no lengths: they come from the user's own SMPL file, J = R (v + S beta) with its joint
//! regressor R, vertices v and shapes S, or else from the built-in body of a stature. Then the pelvis joint lies at
//! mid-hip, and the spine is divided evenly.
//!
//! Source: Loper et al. 2015, ACM TOG 34:248 (unverified); names and order of joints as in public copies of smplx's
//! `joint_names.py`. Never seen: a file of AMASS or of SMPL. Pinned by: tests/smpl_motions.rs

use super::skeleton::{SkeletonError, SkeletonRecording, skeleton_from_bvh};
use crate::findings::{Code, Findings};
use crate::model::anthropometry::{Build, BuildError, Dimensions};
use crate::numerics::elementary::{asin, atan2};
use crate::numerics::median;
use crate::spatial::{Mat3, Vec3, rotation, rotation_between, rotation_vector};
use ambulo_formats::bvh::{Bvh, Channel, ChannelKind, Joint};
use ambulo_formats::npz::{Data, Npz};

/// Frame rates of recordings [Hz].
const RATES_HZ: [f64; 2] = [5.0, 2000.0];
/// Largest plausible height of a pelvis above the origin of a recording [m]; in centimetres it would be about 90.
const HIGHEST_M: f64 = 20.0;
/// Joints that all models share.
const JOINTS: usize = 22;
/// Their names and parents.
const TREE: [(&str, Option<usize>); JOINTS] = [
    ("Pelvis", None),
    ("L_Hip", Some(0)),
    ("R_Hip", Some(0)),
    ("Spine1", Some(0)),
    ("L_Knee", Some(1)),
    ("R_Knee", Some(2)),
    ("Spine2", Some(3)),
    ("L_Ankle", Some(4)),
    ("R_Ankle", Some(5)),
    ("Spine3", Some(6)),
    ("L_Foot", Some(7)),
    ("R_Foot", Some(8)),
    ("Neck", Some(9)),
    ("L_Collar", Some(9)),
    ("R_Collar", Some(9)),
    ("Head", Some(12)),
    ("L_Shoulder", Some(13)),
    ("R_Shoulder", Some(14)),
    ("L_Elbow", Some(16)),
    ("R_Elbow", Some(17)),
    ("L_Wrist", Some(18)),
    ("R_Wrist", Some(19)),
];
/// Joints whose bone ends without a further joint: feet and hands.
const LEFT_FOOT: usize = 10;
const RIGHT_FOOT: usize = 11;
/// Names of the frame rate.
const RATES: [&str; 5] = ["mocap_framerate", "mocap_frame_rate", "framerate", "frame_rate", "fps"];
/// Names of the position of the body.
const PLACES: [&str; 2] = ["trans", "transl"];
/// Names of the rotation of the pelvis, and of the rotations of the other joints.
const ROOTS: [&str; 2] = ["root_orient", "global_orient"];
const BODIES: [&str; 2] = ["pose_body", "body_pose"];
/// Joints with the pelvis: of the body alone, of SMPL, SMPL-H and SMPL-X.
const COUNTS: [usize; 4] = [22, 24, 52, 55];
/// Most joints that any model has.
const MOST_JOINTS: usize = 60;
/// Longest rotation vector [rad]: two turns. A network leaves them within one; in degrees a bent knee has 60.
const LONGEST_RAD: f64 = 4.0 * std::f64::consts::PI;
/// Largest difference of R Rᵀ from the unit matrix.
const MATRIX_DEFECT: f64 = 1e-2;

/// A motion without lengths.
#[derive(Debug, Clone, PartialEq)]
pub struct SmplMotion {
    /// Frame rate as stated [Hz].
    pub rate_hz: f64,
    /// Rotation vectors of the joints, one entry per frame [rad]; not a number where they are missing.
    pub rotations: Vec<[Vec3; JOINTS]>,
    /// Position of the body, one per frame [m].
    pub translations: Vec<Vec3>,
    /// Shape of the body; empty if not stated.
    pub betas: Vec<f64>,
}

/// Joint centres in the resting pose [m]: x to the left, y up, z forward.
#[derive(Debug, Clone, PartialEq)]
pub struct SmplBody {
    joints: [Vec3; JOINTS],
    /// Distance from the ball of the foot to the tip of the toes [m].
    ball_to_toe: f64,
    /// Where the lengths come from, in words.
    statement: String,
}

/// Why a file is no motion or body of the SMPL family.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SmplError {
    /// An array is missing.
    #[error(
        "no array `{wanted}`; found {found}; expected a motion of the SMPL family: poses, trans and mocap_framerate, \
         as in AMASS"
    )]
    NoMotion {
        /// The array.
        wanted: String,
        /// Names of the arrays.
        found: String,
    },
    /// An array of the model is missing.
    #[error(
        "no array `{wanted}`; found {found}; expected a SMPL, SMPL-H or SMPL-X model: v_template, shapedirs and \
         J_regressor"
    )]
    NoBody {
        /// The array.
        wanted: String,
        /// Names of the arrays.
        found: String,
    },
    /// An array of another type.
    #[error(
        "the array `{array}` holds `{found}`; expected numbers (pickled objects, `|O`, are not opened). hint: save the \
         array as numbers"
    )]
    NoNumbers {
        /// The array.
        array: String,
        /// Type of the array.
        found: String,
    },
    /// An array of another shape.
    #[error("the array `{array}` has the shape {found:?}; expected {expected}")]
    Shape {
        /// The array.
        array: String,
        /// Shape of the array.
        found: Vec<usize>,
        /// Allowed values.
        expected: &'static str,
    },
    /// Rotations in a representation without an agreed order of its numbers.
    #[error(
        "the array `{array}` has {found} for each joint, whose order differs between programs; expected rotation \
         vectors (3 numbers) or matrices (3 x 3). hint: convert them, as by scipy's Rotation(...).as_rotvec()"
    )]
    Representation {
        /// The array.
        array: String,
        /// The representation.
        found: &'static str,
    },
    /// Numbers that are no rotations.
    #[error("the array `{array}` has {found}; expected {expected}")]
    NoRotation {
        /// The array.
        array: String,
        /// Description of the numbers.
        found: String,
        /// Allowed values.
        expected: &'static str,
    },
    /// Rotations and places of different numbers of frames.
    #[error("found rotations of {poses} frames and `trans` of {trans} frames; expected the same number")]
    Frames {
        /// Frames of the rotations.
        poses: usize,
        /// Frames of the places.
        trans: usize,
    },
    /// A frame rate that no recording has.
    #[error(
        "the frame rate is {found} Hz; expected {} to {} frames per second. hint: is it the time from one frame to the \
         next?",
        RATES_HZ[0],
        RATES_HZ[1]
    )]
    Rate {
        /// The stated rate [Hz].
        found: f64,
    },
    /// Places that are not in metres.
    #[error(
        "the pelvis is {found} above the origin (median of `trans`), which is no height in metres; expected at most \
         {HIGHEST_M}. hint: is `trans` in millimetres or centimetres? Divide it by 1000 or 100"
    )]
    NotMetres {
        /// Median height in the unit of the file.
        found: f64,
    },
    /// Neither stature nor model.
    #[error(
        "the file has no lengths; expected the stature of the person, or the SMPL model that the motion was made with"
    )]
    NoLengths,
    /// A stature that no person has.
    #[error(transparent)]
    Stature(#[from] BuildError),
    /// The skeleton.
    #[error(transparent)]
    Skeleton(#[from] SkeletonError),
}

/// Numbers and the shape of their array.
type Shaped<'n> = (&'n [f64], &'n [usize]);

/// The numbers of an array; `None` if there is no such array.
fn numbers<'n>(npz: &'n Npz, name: &str) -> Option<Result<Shaped<'n>, SmplError>> {
    let array = npz.array(name)?;
    Some(match &array.data {
        Data::Numbers(numbers) => Ok((numbers, &array.shape)),
        Data::Text(_) => Err(SmplError::NoNumbers { array: name.to_owned(), found: "a text".to_owned() }),
        Data::Texts { kind, .. } | Data::Other(kind) => {
            Err(SmplError::NoNumbers { array: name.to_owned(), found: kind.clone() })
        }
    })
}

/// How the rotations of an array are written.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Form {
    Vectors,
    Matrices,
}

impl Form {
    fn size(self) -> usize {
        match self {
            Form::Vectors => 3,
            Form::Matrices => 9,
        }
    }
}

/// An array of rotations by its shape.
struct Rotations {
    name: &'static str,
    form: Form,
    frames: usize,
    /// Numbers of a frame.
    width: usize,
}

const POSES: &str = "frames x 66 or more: 72 for SMPL, 156 for SMPL-H, 165 for SMPL-X; or frames x joints x 3 (x 3)";

impl Rotations {
    /// The form of `joints` joints or more in the array with one of these names.
    fn of(npz: &Npz, aliases: &[&'static str], joints: usize) -> Result<Rotations, SmplError> {
        let (name, (_, shape)) = first(npz, aliases)?;
        let inner: &[usize] = shape.get(1..).unwrap_or_default();
        let width: usize = inner.iter().product();
        let wrong = || SmplError::Shape { array: name.to_owned(), found: shape.to_vec(), expected: POSES };
        let has = |count: usize| (joints == 1 && count == 1) || (joints > 1 && count >= joints);
        // A last axis shows the form; a flat row shows it by its length.
        let by_axes = match inner {
            [.., 3, 3] if has(width / 9) => Some(9),
            [.., _, last @ (3 | 4 | 6 | 9)] if has(width / last) => Some(*last),
            [last @ (3 | 4 | 6 | 9)] if joints == 1 => Some(*last),
            _ => None,
        };
        let of_pelvis = if joints == JOINTS { 0 } else { 1 };
        let is_usual = |size: &usize| COUNTS.iter().any(|count| width == size * (count - of_pelvis));
        let is_flat = inner.len() == 1 && joints > 1;
        let by_length = || [3, 9, 4, 6].into_iter().find(is_usual).filter(|_| is_flat);
        let vectors =
            || (is_flat && width.is_multiple_of(3) && (joints..=MOST_JOINTS).contains(&(width / 3))).then_some(3);
        let form = match by_axes.or_else(by_length).or_else(vectors) {
            Some(3) => Form::Vectors,
            Some(9) => Form::Matrices,
            Some(size) => {
                let found = if size == 4 { "quaternions (4 numbers)" } else { "6 numbers" };
                return Err(SmplError::Representation { array: name.to_owned(), found });
            }
            None => return Err(wrong()),
        };
        Ok(Rotations { name, form, frames: shape[0], width })
    }

    /// The rotation vectors of the first joints, one row per frame [rad].
    fn read(&self, npz: &Npz, joints: usize) -> Result<Vec<Vec<Vec3>>, SmplError> {
        let values = numbers(npz, self.name).unwrap_or_else(|| Err(no_motion(npz, self.name)))?.0;
        let size = self.form.size();
        let row = |row: &[f64]| row.chunks_exact(size).take(joints).map(|part| self.vector(part)).collect();
        let rows: Vec<Vec<Vec3>> = values.chunks_exact(self.width).map(row).collect::<Result<_, SmplError>>()?;
        let longest = rows.iter().flatten().map(|v| v.norm()).filter(|x| x.is_finite()).fold(0.0, f64::max);
        if longest > LONGEST_RAD {
            let found = format!("rotations of up to {longest:.0} rad, which look like degrees");
            return Err(self.no_rotation(found, "rotation vectors in radians"));
        }
        Ok(rows)
    }

    fn vector(&self, part: &[f64]) -> Result<Vec3, SmplError> {
        if self.form == Form::Vectors {
            return Ok(vector(part));
        }
        if part.iter().any(|x| !x.is_finite()) {
            return Ok(Vec3::repeat(f64::NAN));
        }
        let matrix = Mat3::from_row_slice(part);
        if (matrix * matrix.transpose() - Mat3::identity()).amax() > MATRIX_DEFECT || matrix.determinant() < 0.0 {
            let found = "nine numbers for each joint that are no rotation matrices".to_owned();
            return Err(self.no_rotation(found, "rotation matrices, row by row, or rotation vectors"));
        }
        Ok(rotation_vector(&matrix))
    }

    fn no_rotation(&self, found: String, expected: &'static str) -> SmplError {
        SmplError::NoRotation { array: self.name.to_owned(), found, expected }
    }
}

/// The first of these arrays that the file has, with its name; the error names the first.
fn first<'n>(npz: &'n Npz, aliases: &[&'static str]) -> Result<(&'static str, Shaped<'n>), SmplError> {
    let found = aliases.iter().find_map(|name| Some((*name, numbers(npz, name)?)));
    let (name, shaped) = found.ok_or_else(|| no_motion(npz, aliases[0]))?;
    Ok((name, shaped?))
}

/// Shapes of the arrays of a motion.
struct Layout {
    /// Rotations of all joints, or of the pelvis and of the other joints.
    rotations: Vec<(Rotations, usize)>,
    places: &'static str,
    frames: usize,
}

impl Layout {
    fn of(npz: &Npz) -> Result<Layout, SmplError> {
        let (places, (_, shape)) = first(npz, &PLACES)?;
        let [frames, 3] = *shape else {
            let array = places.to_owned();
            return Err(SmplError::Shape { array, found: shape.to_vec(), expected: "frames x 3" });
        };
        let rotations = if npz.array("poses").is_some() {
            vec![(Rotations::of(npz, &["poses"], JOINTS)?, JOINTS)]
        } else if BODIES.iter().any(|name| npz.array(name).is_some()) {
            let root = Rotations::of(npz, &ROOTS, 1)?;
            vec![(root, 1), (Rotations::of(npz, &BODIES, JOINTS - 1)?, JOINTS - 1)]
        } else {
            return Err(no_motion(npz, "poses"));
        };
        if let Some((odd, _)) = rotations.iter().find(|(part, _)| part.frames != frames) {
            return Err(SmplError::Frames { poses: odd.frames, trans: frames });
        }
        Ok(Layout { rotations, places, frames })
    }
}

fn names(npz: &Npz) -> String {
    let names: Vec<&str> = npz.arrays.iter().take(20).map(|(name, _)| name.as_str()).collect();
    if names.is_empty() { "no arrays".to_owned() } else { names.join(", ") }
}

fn no_motion(npz: &Npz, wanted: &str) -> SmplError {
    SmplError::NoMotion { wanted: wanted.to_owned(), found: names(npz) }
}

fn vector(three: &[f64]) -> Vec3 {
    let is_finite = three.iter().all(|x| x.is_finite());
    if is_finite { Vec3::new(three[0], three[1], three[2]) } else { Vec3::repeat(f64::NAN) }
}

impl SmplMotion {
    /// Whether a motion has an array of this name.
    #[must_use]
    pub fn is_array(name: &str) -> bool {
        let lists: [&[&str]; 5] = [&PLACES, &ROOTS, &BODIES, &RATES, &["poses", "betas"]];
        lists.iter().any(|names| names.contains(&name))
    }

    /// Checks names and shapes of the arrays, which may be without their elements.
    ///
    /// # Errors
    /// As [`SmplMotion::from_npz`].
    pub fn check_shapes(npz: &Npz) -> Result<(), SmplError> {
        Layout::of(npz).map(|_| ())
    }

    /// Reads a motion.
    ///
    /// # Errors
    /// Arrays that are missing, of another type or shape, or without a frame rate.
    pub fn from_npz(npz: &Npz) -> Result<SmplMotion, SmplError> {
        let Layout { rotations, places, frames } = Layout::of(npz)?;
        let rate = RATES.iter().find_map(|name| numbers(npz, name)).unwrap_or_else(|| Err(no_motion(npz, RATES[0])))?;
        let rate_hz = rate.0.first().copied().unwrap_or(f64::NAN);
        if !(RATES_HZ[0]..=RATES_HZ[1]).contains(&rate_hz) {
            return Err(SmplError::Rate { found: rate_hz });
        }
        let parts: Vec<Vec<Vec<Vec3>>> =
            rotations.iter().map(|(part, joints)| part.read(npz, *joints)).collect::<Result<_, SmplError>>()?;
        let of_frame = |frame: usize| {
            let mut joints = parts.iter().flat_map(|part| part[frame].iter().copied());
            std::array::from_fn(|_| joints.next().unwrap_or(Vec3::repeat(f64::NAN)))
        };
        let betas = numbers(npz, "betas").and_then(Result::ok).map_or(Vec::new(), |(betas, _)| betas.to_vec());
        let (values, _) = numbers(npz, places).unwrap_or_else(|| Err(no_motion(npz, places)))?;
        let motion = SmplMotion {
            rate_hz,
            rotations: (0..frames).map(of_frame).collect(),
            translations: values.chunks_exact(3).map(vector).collect(),
            betas,
        };
        motion.check_unit()?;
        Ok(motion)
    }

    /// Checks that the places are in metres: the pelvis of a person is about a metre above the floor, where the origin
    /// is.
    fn check_unit(&self) -> Result<(), SmplError> {
        let to_upright = self.upright_from_file();
        let heights = self.translations.iter().map(|place| (to_upright * place).y.abs()).filter(|y| y.is_finite());
        match median(heights) {
            Some(found) if found > HIGHEST_M => Err(SmplError::NotMetres { found: found.round() }),
            _ => Ok(()),
        }
    }

    /// The motion of a body as a skeleton, in the axes of the world.
    ///
    /// # Errors
    /// Fewer than two frames, a person who is never upright.
    pub fn skeleton(
        &self,
        body: &SmplBody,
        name: &str,
        height_m: Option<f64>,
        findings: &mut Findings,
    ) -> Result<SkeletonRecording, SmplError> {
        let bvh = self.bvh(body)?;
        let mut skeleton = skeleton_from_bvh(&bvh, name, height_m, findings)?;
        skeleton.statement = format!("{}; {}", body.statement, skeleton.statement);
        findings.report(Code::SmplBody, format!("a motion of the SMPL family has no lengths: {}", body.statement));
        Ok(skeleton)
    }

    /// The motion with y up as the resting pose has it, which the rotations of the pelvis show.
    fn bvh(&self, body: &SmplBody) -> Result<Bvh, SmplError> {
        let turned = self.upright_from_file();
        let order = depth_first();
        let zxy = [(ChannelKind::Rotation, 2), (ChannelKind::Rotation, 0), (ChannelKind::Rotation, 1)];
        let xyz = [0, 1, 2].map(|axis| (ChannelKind::Position, axis));
        let place_in_order = |joint: usize| order.iter().position(|other| *other == joint);
        let joint = |k: &usize| {
            let (name, parent) = TREE[*k];
            let offset = body.joints[*k] - parent.map_or_else(Vec3::zeros, |parent| body.joints[parent]);
            let channels = xyz.iter().filter(|_| parent.is_none()).chain(&zxy);
            Joint {
                name: name.to_owned(),
                parent: parent.and_then(place_in_order),
                offset: offset.into(),
                channels: channels.map(|(kind, axis)| Channel { kind: *kind, axis: *axis }).collect(),
                end_sites: body.end_of(*k).map(Into::into).into_iter().collect(),
            }
        };
        let frame = |(rotations, translation): (&[Vec3; JOINTS], &Vec3)| {
            let place = turned * (translation + body.joints[0]);
            let mut values: Vec<f64> = place.iter().copied().collect();
            for k in &order {
                let own = rotation(&rotations[*k]);
                values.extend(angles_zxy(&if *k == 0 { turned * own } else { own }).map(f64::to_degrees));
            }
            values
        };
        let frames: Vec<Vec<f64>> = self.rotations.iter().zip(&self.translations).map(frame).collect();
        let joints = order.iter().map(joint).collect();
        Bvh::new(joints, 1.0 / self.rate_hz, &frames).map_err(|_| SmplError::Rate { found: self.rate_hz })
    }

    /// A rotation by quarter turns that brings the mean upward direction of the pelvis to y.
    fn upright_from_file(&self) -> Mat3 {
        let up = |rotations: &[Vec3; JOINTS]| rotation(&rotations[0]) * Vec3::y();
        let mean: Vec3 = self.rotations.iter().map(up).filter(|up| up.iter().all(|x| x.is_finite())).sum();
        let axis = mean.iamax();
        let nearest = Vec3::ith(axis, mean[axis].signum());
        rotation_between(&nearest, &Vec3::y()).unwrap_or_else(|| Mat3::from_diagonal(&Vec3::new(1.0, -1.0, -1.0)))
    }
}

/// The joints, each before its children and after its parent, branch by branch.
fn depth_first() -> Vec<usize> {
    let (mut order, mut next) = (Vec::with_capacity(JOINTS), vec![0]);
    while let Some(joint) = next.pop() {
        order.push(joint);
        next.extend((0..JOINTS).rev().filter(|child| TREE[*child].1 == Some(joint)));
    }
    order
}

/// Angles about z, then x, then y: R = Rz Rx Ry [rad].
fn angles_zxy(r: &Mat3) -> [f64; 3] {
    let about_x = asin(r[(2, 1)].clamp(-1.0, 1.0));
    [atan2(-r[(0, 1)], r[(1, 1)]), about_x, atan2(-r[(2, 0)], r[(2, 2)])]
}

impl SmplBody {
    /// Whether a model has an array of this name that is needed here.
    #[must_use]
    pub fn is_array(name: &str) -> bool {
        ["v_template", "shapedirs", "J_regressor"].contains(&name)
    }

    /// Joint centres of the built-in body of this stature.
    ///
    /// # Errors
    /// An implausible mass or stature.
    pub fn of_stature(build: &Build) -> Result<SmplBody, SmplError> {
        let sizes = build.human()?.dimensions;
        let hip = sizes.hip_width / 2.0;
        let (knee, ankle) = (-sizes.thigh, -sizes.thigh - sizes.shank);
        let ball = Vec3::new(0.0, ankle - sizes.ankle_height + sizes.ball_radius, sizes.ankle_to_ball);
        let (shoulder, high) = (sizes.shoulder_width / 2.0, sizes.shoulder_height);
        let elbow = shoulder + sizes.upper_arm;
        let wrist = elbow + sizes.forearm;
        // Right side; the left side is its mirror image.
        let right = |joint: &str| match joint {
            "Hip" => Vec3::new(-hip, 0.0, 0.0),
            "Knee" => Vec3::new(-hip, knee, 0.0),
            "Ankle" => Vec3::new(-hip, ankle, 0.0),
            "Foot" => ball - hip * Vec3::x(),
            "Collar" => Vec3::new(-shoulder / 2.0, high, 0.0),
            "Shoulder" => Vec3::new(-shoulder, high, 0.0),
            "Elbow" => Vec3::new(-elbow, high, 0.0),
            _ => Vec3::new(-wrist, high, 0.0),
        };
        let place = |(name, _): (&str, Option<usize>)| match name.split_once('_') {
            Some(("L", joint)) => right(joint).component_mul(&Vec3::new(-1.0, 1.0, 1.0)),
            Some((_, joint)) => right(joint),
            None => match name {
                "Spine1" => high / 4.0 * Vec3::y(),
                "Spine2" => high / 2.0 * Vec3::y(),
                "Spine3" => 0.75 * high * Vec3::y(),
                "Neck" => high * Vec3::y(),
                "Head" => (high + sizes.head / 2.0) * Vec3::y(),
                _ => Vec3::zeros(),
            },
        };
        let statement = format!("lengths are those of the built-in body at a stature of {:.2} m", sizes.height);
        Ok(SmplBody { joints: TREE.map(place), ball_to_toe: sizes.ball_to_toe, statement })
    }

    /// Joint centres of the user's model for this shape; `table` gives the toes their length, which the model has not.
    ///
    /// # Errors
    /// Arrays that are missing, of another type or shape.
    pub fn of_model(npz: &Npz, betas: &[f64], table: &Dimensions) -> Result<SmplBody, SmplError> {
        let need = |name: &str| {
            let no_body = || Err(SmplError::NoBody { wanted: name.to_owned(), found: names(npz) });
            numbers(npz, name).unwrap_or_else(no_body)
        };
        let wrong = |array: &str, found: &[usize], expected: &'static str| {
            Err(SmplError::Shape { array: array.to_owned(), found: found.to_vec(), expected })
        };
        let (template, shape) = need("v_template")?;
        let [vertices, 3] = *shape else { return wrong("v_template", shape, "vertices x 3") };
        let (shapes, shape) = need("shapedirs")?;
        let [of_shapes, 3, count] = *shape else { return wrong("shapedirs", shape, "vertices x 3 x shapes") };
        if of_shapes != vertices {
            return wrong("shapedirs", shape, "as many vertices as `v_template`");
        }
        let (regressor, shape) = need("J_regressor")?;
        let [of_joints, of_regressor] = *shape else {
            return wrong("J_regressor", shape, "22 joints or more x vertices");
        };
        if of_regressor != vertices || of_joints < JOINTS {
            return wrong("J_regressor", shape, "22 joints or more, and as many vertices as `v_template`");
        }
        let place = |vertex: usize, axis: usize| {
            let at = 3 * vertex + axis;
            let shaped = shapes[at * count..(at + 1) * count].iter().zip(betas).map(|(s, beta)| s * beta);
            template[at] + shaped.sum::<f64>()
        };
        let centre = |joint: usize| {
            let weights = regressor[joint * vertices..(joint + 1) * vertices].iter().enumerate();
            let weighted = weights.filter(|(_, weight)| **weight != 0.0);
            weighted.map(|(v, weight)| *weight * Vec3::from_fn(|axis, _| place(v, axis))).sum()
        };
        let joints: [Vec3; JOINTS] = std::array::from_fn(centre);
        let ankle_to_ball = (joints[LEFT_FOOT] - joints[7]).norm();
        let ball_to_toe = table.ball_to_toe / table.ankle_to_ball * ankle_to_ball;
        let used = betas.len().min(count);
        Ok(SmplBody {
            joints,
            ball_to_toe,
            statement: format!("lengths are those of the given SMPL model with {used} shape numbers"),
        })
    }

    /// The end of the bone of a joint without children, in its axes.
    fn end_of(&self, joint: usize) -> Option<Vec3> {
        let is_end = TREE.iter().all(|(_, parent)| *parent != Some(joint));
        let of_foot = [LEFT_FOOT, RIGHT_FOOT].contains(&joint).then(|| self.ball_to_toe * Vec3::z());
        is_end.then(|| of_foot.unwrap_or_else(Vec3::zeros))
    }
}
