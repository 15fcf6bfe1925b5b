//! From a source to a body whose coordinates are known over time, with the measured forces under its feet.

use super::error::StudyError;
use super::events::are_believed;
use super::fitted_range::fitted_range;
use super::force_table::{TableForces, Walker, is_loaded};
use super::idle_forces::IdleForces;
use super::laboratory_file::LaboratoryFile;
use super::mass::{KnownMass, MassEstimate, report_decided};
use super::origin::Tracking;
use super::region_fit::RegionFit;
use super::settings::{GroundSettings, Settings};
use super::size::StatedSize;
use super::source::{
    AddedMass, CompleteMotion, MarkerBody, MarkerSource, MeasuredForces, PlateAssignment, PlateUse, Recording,
    SensorBody, SensorSource, Source,
};
use super::weighing::Carried;
use crate::analysis::feasibility::Person;
use crate::analysis::{
    AnalysisError, BodyInMotion, BodySource, LaboratoryRecording, MarkerTrial, Progress, Stage, fit_body_to_markers,
    joints_of_movement,
};
use crate::findings::{Code, Findings};
use crate::ground::plates::{ContactQuality, PlateContact};
use crate::ground::predict::checksum;
use crate::kinematics::Trajectory;
use crate::kinematics::calibration::{self, BodyMeasurements, JointCentres};
use crate::kinematics::retarget::retarget;
use crate::kinematics::sensor_fit::{SensorTrial, fit_sensors};
use crate::model::anthropometry::Build;
use crate::model::full_body::full_body;
use crate::model::{Model, Side};
use crate::motion::force_plate::{ForceUnit, PlateRecording, stepped_weight};
use crate::motion::skeleton::SkeletonRecording;
use crate::motion::{Event, ForceRecording, Motion, SmoothSettings, SubjectParameters, Window, smooth};
use crate::numerics::median;
use crate::spatial::{STANDARD_GRAVITY, Vec3};
use ambulo_formats::table::Table;
use std::borrow::Cow;
use std::sync::Arc;

/// A body and the forces under its feet, as observed.
pub(super) struct Observation {
    pub(super) model: Model,
    pub(super) person: Person,
    pub(super) forces: Vec<ForceRecording>,
    /// Measured forces that do not carry the person.
    pub(super) idle: IdleForces,
    pub(super) origin: Origin,
    /// Whether the forces come from the force plates of the recording.
    pub(super) is_from_plates: bool,
    /// Estimates of the body mass that do not need the motion.
    pub(super) known_mass: KnownMass,
    /// Joint moments of a worn device.
    pub(super) device: Option<Table>,
    /// Whether the mass comes from a given model alone: none is stated, and no load was added.
    pub(super) has_models_mass: bool,
}

/// A motion as observed. It is stored separately from the body, because a long motion is dropped after smoothing.
#[derive(Clone)]
pub(super) enum ObservedMotion {
    /// Samples, possibly with gaps.
    Recorded(Motion),
    /// Complete, with the exact forces of a simulation.
    Complete(Trajectory),
}

/// Data of a recording other than the motion.
struct Statements {
    forces: MeasuredForces,
    device: Option<Table>,
    added_mass: Vec<AddedMass>,
    stated: StatedSize,
    movement: Option<Arc<LaboratoryFile>>,
}

/// The kind of recording that a body in motion was made from.
pub(super) enum Origin {
    Coordinates,
    Markers(Box<Followed>),
    Skeleton(Box<Tracking>),
    /// Orientations of sensors, which do not show where the person is.
    Sensors,
    Simulation {
        rule: &'static str,
    },
}

/// A body that followed markers, and further statements of the files.
pub(super) struct Followed {
    pub(super) body: BodyInMotion,
    /// Foot strikes and foot offs that the file lists.
    pub(super) listed: Vec<Event>,
    /// Whether they agree with the force plates.
    pub(super) is_list_believed: bool,
    /// Checksum of the name of the person in the file; names stay out of the results.
    pub(super) subject: Option<u64>,
}

impl Observation {
    /// Body mass measured by force plates in a standing trial [kg].
    pub(super) fn standing_kg(&self) -> Option<f64> {
        self.known_mass.standing.as_ref().map(|standing| standing.kg)
    }

    /// The ways in which the ground forces weigh the body.
    pub(super) fn weighed_in_motion(&self, trajectory: &Trajectory) -> Vec<MassEstimate> {
        if self.forces.is_empty() || matches!(self.origin, Origin::Simulation { .. }) {
            return Vec::new();
        }
        let body = self.origin.followed().map(|followed| &followed.body);
        Carried::new(&self.model, trajectory, &self.forces, &self.person.soles, body).estimates()
    }

    /// Whether a mass that force plates measure replaces the mass of the model.
    pub(super) fn takes_weighed_mass(&self) -> bool {
        self.has_models_mass && (!self.forces.is_empty() || self.known_mass.standing.is_some())
    }

    /// Scales the masses of the model to a weighed body mass [kg].
    pub(super) fn scale_to(&mut self, kg: f64, findings: &mut Findings) -> Result<(), StudyError> {
        let own_kg = self.model.mass();
        let factors = vec![Vec3::repeat(1.0); self.model.bodies().len()];
        self.model = self.model.scaled(&factors, Some(kg)).map_err(StudyError::Size)?;
        self.person.mass_kg *= kg / own_kg;
        let message = format!(
            "the model has {own_kg:.1} kg, the force plates carry {kg:.1} kg, and no mass is stated: masses and \
             inertias of \
             the model were multiplied by {:.3}",
            kg / own_kg
        );
        findings.report(Code::MassReplaced, message);
        Ok(())
    }

    /// Whether forces are predicted: on request, or if no forces were measured.
    pub(super) fn is_predicted(&self, settings: &Settings) -> bool {
        match (&self.origin, settings.ground) {
            (Origin::Simulation { .. }, _) | (_, GroundSettings::NoContact) => false,
            (_, GroundSettings::Predicted | GroundSettings::Tracked) => true,
            (_, GroundSettings::MeasuredOrPredicted) => self.forces.is_empty(),
        }
    }
}

impl Origin {
    /// Checksum of the name of the person in the file.
    pub(super) fn subject(&self) -> Option<u64> {
        self.followed()?.subject
    }

    pub(super) fn followed(&self) -> Option<&Followed> {
        match self {
            Origin::Markers(followed) => Some(followed),
            Origin::Coordinates | Origin::Skeleton(_) | Origin::Sensors | Origin::Simulation { .. } => None,
        }
    }

    /// The longest time during which plates measured all that the ground did.
    pub(super) fn instrumented(&self) -> Option<Window> {
        let [from, to] = *self.followed()?.body.on_plates.windows.first()?;
        Some(Window { from_s: Some(from), to_s: Some(to) })
    }

    /// Times in which a force plate measured only a part of a foot's load [s].
    pub(super) fn partly_measured(&self) -> Vec<[f64; 2]> {
        let contacts = self.followed().map_or(&[][..], |followed| &followed.body.on_plates.contacts);
        let parts = contacts.iter().filter(|contact| contact.quality == ContactQuality::Partial);
        parts.map(|contact| [contact.start_s, contact.end_s]).collect()
    }

    /// Whether the directions of both feet are known.
    pub(super) fn shows_both_feet(&self) -> bool {
        self.followed().is_none_or(|followed| followed.body.feet.feet_without_markers.is_empty())
    }
}

impl Source {
    /// The body and the motion that this source describes.
    pub(super) fn observe(
        self,
        settings: &Settings,
        findings: &mut Findings,
        progress: &mut Progress<'_>,
    ) -> Result<(Observation, ObservedMotion), StudyError> {
        let Source { recording, forces, device, added_mass, stated, movement, muscles: _ } = self;
        let statements =
            Statements { forces: forces.without_delay(settings.force_delay_s), device, added_mass, stated, movement };
        let recording = recording.with_sound_clock(settings.force_delay_s, findings)?;
        match recording {
            Recording::Coordinates { model, motion } => {
                statements.observe_coordinates(&model, motion, settings, findings)
            }
            Recording::Sensors(sensors) => statements.observe_sensors(&sensors, settings, findings, progress),
            Recording::Markers(markers) => statements.observe_markers(*markers, settings, findings, progress),
            Recording::Skeleton { skeleton, table, mass_kg } => {
                let build = Build { table, mass: mass_kg, height: skeleton.height_m, toe_joint: true };
                statements.observe_skeleton(&skeleton, &build, settings, findings, progress)
            }
            Recording::Complete(made) => statements.observe_complete(*made),
        }
    }
}

impl Statements {
    /// A model with the masses that the person carried.
    fn loaded(&self, model: Model) -> Result<Model, StudyError> {
        self.added_mass.iter().try_fold(model, |model, added| added.on(&model))
    }

    fn observe_complete(self, made: CompleteMotion) -> Result<(Observation, ObservedMotion), StudyError> {
        let CompleteMotion { model, person, trajectory, loads, rule } = made;
        let known_mass = KnownMass::stated(Some(model.mass()));
        let observation = Observation {
            model: self.loaded(model)?,
            person,
            forces: loads,
            idle: IdleForces::default(),
            is_from_plates: false,
            origin: Origin::Simulation { rule },
            known_mass,
            device: self.device,
            has_models_mass: false,
        };
        Ok((observation, ObservedMotion::Complete(trajectory)))
    }

    fn observe_coordinates(
        self,
        model: &Model,
        motion: Motion,
        settings: &Settings,
        findings: &mut Findings,
    ) -> Result<(Observation, ObservedMotion), StudyError> {
        let is_measured =
            settings.ground != GroundSettings::NoContact && !matches!(self.forces, MeasuredForces::InRecording);
        let motion = self.stated.moved(model, motion, is_measured);
        let model = self.stated.applied(model, findings)?;
        // A carried load does not change the person's strength.
        let person = Person { estimated: self.stated.height_m.is_none(), ..Person::of_model(&model) };
        let model = self.loaded(model)?;
        self.with_forces((model, person, motion), Origin::Coordinates, settings, findings)
    }

    fn observe_sensors(
        self,
        sensors: &SensorSource,
        settings: &Settings,
        findings: &mut Findings,
        progress: &mut Progress<'_>,
    ) -> Result<(Observation, ObservedMotion), StudyError> {
        let (model, person) = match &sensors.body {
            SensorBody::BuiltIn(build) => {
                let human = full_body(build)?;
                let person = Person::of_human(&human);
                (human.model, person)
            }
            SensorBody::Model(model) => {
                let model = self.stated.applied(model, findings)?;
                let person = Person { estimated: self.stated.height_m.is_none(), ..Person::of_model(&model) };
                (model, person)
            }
        };
        let model = self.loaded(model)?;
        progress.end(Stage::Body)?;
        let trial = SensorTrial { moving: &sensors.moving, standing: sensors.standing.as_ref(), axes: &sensors.axes };
        let fit = fit_sensors(&model, &person.soles, &trial, &settings.marker_fit, findings)?;
        progress.end(Stage::Markers)?;
        self.with_forces((model, person, fit.motion), Origin::Sensors, settings, findings)
    }

    /// A body in motion with the forces that were measured apart from it, or none.
    fn with_forces(
        self,
        (model, person, motion): (Model, Person, Motion),
        origin: Origin,
        settings: &Settings,
        findings: &mut Findings,
    ) -> Result<(Observation, ObservedMotion), StudyError> {
        let (forces, idle) = match self.forces {
            _ if settings.ground == GroundSettings::NoContact => (Vec::new(), IdleForces::default()),
            MeasuredForces::InRecording => {
                let message = "no ground forces were given; they are predicted from the motion";
                findings.report(Code::GroundPredicted, message);
                (Vec::new(), IdleForces::default())
            }
            MeasuredForces::OnBodies(forces) => (forces, IdleForces::default()),
            MeasuredForces::Table(table) => {
                let walker = Walker {
                    model: &model,
                    motion: &motion,
                    soles: &person.soles,
                    window: settings.window,
                    world_from_lab: None,
                    delay_s: settings.force_delay_s,
                };
                carrying(walker.forces_of_table(&table, findings)?, findings)
            }
        };
        let known_mass = KnownMass::stated(self.stated.mass_kg);
        let has_models_mass =
            matches!(origin, Origin::Coordinates) && self.stated.mass_kg.is_none() && self.added_mass.is_empty();
        let (device, is_from_plates) = (self.device, false);
        let observation =
            Observation { person, model, forces, idle, origin, is_from_plates, known_mass, device, has_models_mass };
        Ok((observation, ObservedMotion::Recorded(motion)))
    }

    fn observe_skeleton(
        self,
        skeleton: &SkeletonRecording,
        build: &Build,
        settings: &Settings,
        findings: &mut Findings,
        progress: &mut Progress<'_>,
    ) -> Result<(Observation, ObservedMotion), StudyError> {
        let body = retarget(build, skeleton, findings)?;
        progress.end(Stage::Markers)?;
        if settings.ground != GroundSettings::NoContact {
            let message = "a skeleton has no ground forces; they are predicted from the motion";
            findings.report(Code::GroundPredicted, message);
        }
        let motion = body.fit.motion.clone();
        let observation = Observation {
            person: Person::of_human(&body.human),
            forces: Vec::new(),
            idle: IdleForces::default(),
            is_from_plates: false,
            origin: Origin::Skeleton(Box::new(Tracking::Skeleton {
                statement: skeleton.statement.clone(),
                regions: RegionFit::of(&body.human.model, &body.fit, &std::collections::BTreeMap::new()),
                fit: Box::new(body.fit),
                flights: body.flights,
            })),
            model: self.loaded(body.human.model)?,
            known_mass: KnownMass::stated(Some(build.mass)),
            device: self.device,
            has_models_mass: false,
        };
        Ok((observation, ObservedMotion::Recorded(motion)))
    }

    fn observe_markers(
        self,
        markers: MarkerSource,
        settings: &Settings,
        findings: &mut Findings,
        progress: &mut Progress<'_>,
    ) -> Result<(Observation, ObservedMotion), StudyError> {
        let known = KnownMass::of_markers(&markers);
        let markers = markers.with_plates_in_newtons(&known, findings);
        let markers = self.with_known_mass(markers, &known, settings, findings)?;
        let mut body = self.follow(&markers, settings, findings, progress)?;
        body.subject.model = self.loaded(body.subject.model)?;
        let (forces, mut idle) = self.forces_under(&body, settings, findings)?;
        if matches!(self.forces, MeasuredForces::InRecording) && settings.ground != GroundSettings::NoContact {
            idle = IdleForces::of_plates(&body, &markers);
            idle.report(findings);
        }
        let motion = body.fit.motion.clone();
        let is_model = matches!(markers.body, MarkerBody::Model { .. });
        let observation = Observation {
            has_models_mass: is_model && known.stated.is_none() && self.added_mass.is_empty(),
            model: body.subject.model.clone(),
            person: body.subject.person.clone(),
            forces,
            idle,
            is_from_plates: matches!(self.forces, MeasuredForces::InRecording),
            known_mass: known,
            origin: Origin::Markers(Box::new(Followed {
                is_list_believed: are_believed(&body, &markers.trial.events, findings),
                body,
                listed: markers.trial.events,
                subject: markers.trial.subject.name.as_deref().map(|name| checksum(&plain(name))),
            })),
            device: self.device,
        };
        Ok((observation, ObservedMotion::Recorded(motion)))
    }

    /// The measured forces on a body that follows markers.
    fn forces_under(
        &self,
        body: &BodyInMotion,
        settings: &Settings,
        findings: &mut Findings,
    ) -> Result<(Vec<ForceRecording>, IdleForces), StudyError> {
        match &self.forces {
            _ if settings.ground == GroundSettings::NoContact => Ok((Vec::new(), IdleForces::default())),
            MeasuredForces::OnBodies(forces) => Ok((forces.clone(), IdleForces::default())),
            MeasuredForces::Table(table) => {
                let whole = body.longest_without_gap_s();
                let walker = Walker {
                    model: &body.subject.model,
                    motion: &body.fit.motion,
                    soles: &body.subject.person.soles,
                    window: whole.map_or(settings.window, |[from, to]| Window { from_s: Some(from), to_s: Some(to) }),
                    world_from_lab: Some(&body.laboratory.world_from_lab),
                    delay_s: settings.force_delay_s,
                };
                Ok(carrying(walker.forces_of_table(table, findings)?, findings))
            }
            MeasuredForces::InRecording => Ok((plate_forces(body, findings), IdleForces::default())),
        }
    }

    /// The markers with the mass of the built-in body. Where statement and standing trial do not settle it, the force
    /// plates weigh the person in motion: the posture does not depend on the mass, so that a first body of any mass
    /// shows the velocity of the mass centre.
    fn with_known_mass(
        &self,
        markers: MarkerSource,
        known: &KnownMass,
        settings: &Settings,
        findings: &mut Findings,
    ) -> Result<MarkerSource, StudyError> {
        if !matches!(markers.body, MarkerBody::BuiltIn { .. }) {
            return Ok(markers);
        }
        let any_kg = known.stated.as_ref().map_or(ANY_MASS_KG, |stated| stated.kg);
        let markers = markers.with_mass(any_kg);
        let in_motion = match known.needs_motion() {
            true => self.weighed_before(&markers, settings)?,
            false => Vec::new(),
        };
        let decided = known.decided(&in_motion).ok_or(StudyError::MassUnknown)?;
        report_decided(known, &decided, findings);
        Ok(markers.with_mass(decided.kg))
    }

    /// The ways in which the ground forces weigh a body that is only there to be weighed.
    fn weighed_before(&self, markers: &MarkerSource, settings: &Settings) -> Result<Vec<MassEstimate>, StudyError> {
        let ignored = &mut Findings::default();
        // The person weighs what all of the recording shows.
        let of_all = Settings { window: Window::default(), ..settings.clone() };
        let body = self.follow(markers, &of_all, ignored, &mut Progress::default())?;
        let (forces, idle) = self.forces_under(&body, settings, ignored)?;
        if idle.is_relative {
            return Ok(Vec::new());
        }
        let model = &body.subject.model;
        let whole = body
            .longest_without_gap_s()
            .map_or(settings.window, |[from, to]| Window { from_s: Some(from), to_s: Some(to) });
        let smoothing = SmoothSettings { smoother: settings.smoother, window: whole, rate_hz: None };
        let smoothed = smooth(model, &body.fit.motion, smoothing, ignored).map_err(AnalysisError::Motion)?;
        let trajectory = Trajectory::complete(model, smoothed, ignored).map_err(AnalysisError::Trajectory)?;
        let subject = &body.subject;
        let weighed = |body: Option<&BodyInMotion>| {
            Carried::new(model, &trajectory, &forces, &subject.person.soles, body).estimates()
        };
        let of_plates = weighed(Some(&body));
        // Plates that are late measure no foot from strike to off; their loads weigh the person all the same.
        Ok(if of_plates.is_empty() { weighed(None) } else { of_plates })
    }

    /// The body, calibrated, scaled or as it is, following the markers.
    fn follow(
        &self,
        markers: &MarkerSource,
        settings: &Settings,
        findings: &mut Findings,
        progress: &mut Progress<'_>,
    ) -> Result<BodyInMotion, StudyError> {
        let trial = markers.with_stated_plates()?;
        let (person, model);
        let body = match &markers.body {
            MarkerBody::Model { model: given, mass_kg, protocol } => {
                let is_scaled_later = protocol.as_ref().is_some_and(|protocol| protocol.scaling.is_some());
                let size = match is_scaled_later {
                    true => StatedSize::default(),
                    false => StatedSize { mass_kg: *mass_kg, height_m: self.stated.height_m },
                };
                model = size.applied(given, findings)?;
                BodySource::Model { model: &model, mass: *mass_kg, protocol: protocol.as_deref() }
            }
            MarkerBody::BuiltIn { set, .. } => {
                person = markers.person(settings)?;
                BodySource::BuiltIn { person: &person, set: set.as_ref() }
            }
            MarkerBody::Calibrated(subject) => BodySource::Calibrated(subject),
        };
        let of_foot = |used: PlateUse| match used {
            PlateUse::Foot(side) => Some(side),
            PlateUse::Off | PlateUse::Flip(_) | PlateUse::Turn(_) => None,
        };
        let plate_feet: Vec<(usize, Side)> = markers
            .plates
            .iter()
            .filter_map(|known| Some((markers.plate_at(known.plate)?, of_foot(known.used)?)))
            .collect();
        let standing = markers.standing.as_deref();
        if let Some(standing) = standing {
            report_other_person(&markers.trial.subject, &standing.subject, findings);
        }
        let mut trial = MarkerTrial {
            trial: &trial,
            standing: standing.map(|standing| &standing.recording),
            bodies: standing.map(|standing| &standing.bodies),
            body,
            plate_feet: &plate_feet,
            window: fitted_range(settings, &trial),
        };
        let shown;
        if let (Some(movement), BodySource::BuiltIn { person, set }) = (&self.movement, &trial.body) {
            let joints = joints_of_movement(&trial, &movement.recording, findings)?;
            let measurements = BodyMeasurements { joints, ..person.measurements };
            shown = calibration::PersonMeasurements { measurements, ..(*person).clone() };
            trial.body = BodySource::BuiltIn { person: &shown, set: *set };
        }
        Ok(fit_body_to_markers(&trial, &settings.marker_fit, findings, progress)?)
    }
}

/// Reports a standing trial whose file names another person; case and blanks do not count. The names stay out of the
/// results.
fn report_other_person(moving: &SubjectParameters, standing: &SubjectParameters, findings: &mut Findings) {
    if let (Some(moving), Some(standing)) = (&moving.name, &standing.name)
        && plain(moving) != plain(standing)
    {
        let message = "the file of the standing trial names another person (SUBJECTS:NAMES) than that of the \
            recording; its body was used";
        findings.report(Code::CalibrationOtherPerson, message);
    }
}

/// A name without what its writers may vary.
fn plain(name: &str) -> String {
    name.trim().to_ascii_lowercase()
}

/// A mass for a body that is only there to be weighed [kg].
const ANY_MASS_KG: f64 = 70.0;

impl MarkerSource {
    /// The same markers with a stated mass of the built-in body [kg].
    fn with_mass(mut self, kg: f64) -> MarkerSource {
        if let MarkerBody::BuiltIn { mass_kg, .. } = &mut self.body {
            *mass_kg = Some(kg);
        }
        self
    }

    /// The place among the plates that were read of a plate of the file, counted from 0; `None` if it was left out.
    pub(super) fn plate_at(&self, plate: usize) -> Option<usize> {
        let plates = &self.trial.recording.plates;
        let name = format!("plate {}", plate + 1);
        let is_numbered = plates.iter().any(|plate| plate.name.starts_with("plate "));
        let by_name = plates.iter().position(|plate| plate.name == name);
        if is_numbered { by_name } else { (plate < plates.len()).then_some(plate) }
    }

    /// The trial as the laboratory states its plates: without what switched-off ones measured, with corrected signs and
    /// directions. Plates that are named must exist; one that was left out anyway may be switched off.
    fn with_stated_plates(&self) -> Result<Cow<'_, LaboratoryRecording>, StudyError> {
        let mut recording = Cow::Borrowed(&self.trial.recording);
        for PlateAssignment { plate, used } in &self.plates {
            let Some(place) = self.plate_at(*plate) else {
                if *used == PlateUse::Off && *plate < self.trial.stated_plates {
                    continue;
                }
                return Err(StudyError::NoSuchPlate { plate: *plate, count: recording.plates.len() });
            };
            let stated = &recording.plates[place];
            let read = match used {
                PlateUse::Foot(_) => continue,
                PlateUse::Off => stated.unloaded(),
                PlateUse::Flip(axis) => stated.flipped(*axis),
                PlateUse::Turn(quarters) => stated.turned(*quarters),
            };
            recording.to_mut().plates[place] = read;
        }
        Ok(recording)
    }

    /// The markers with plates in the unit that a stated or standing mass shows, where the unit of the file cannot be
    /// right.
    fn with_plates_in_newtons(mut self, known: &KnownMass, findings: &mut Findings) -> MarkerSource {
        let weight_n = known.stated.as_ref().or(known.standing.as_ref()).map(|mass| mass.kg * STANDARD_GRAVITY);
        let plates = &mut self.trial.recording.plates;
        let assumed = plates.first().and_then(|plate| plate.assumed_units);
        let Some(([assumed_n, _], weight_n)) = assumed.zip(weight_n) else { return self };
        let vertical = |plate: &PlateRecording| (0..plate.times.len()).map(|i| plate.vertical(i)).collect::<Vec<_>>();
        let stepped = median(plates.iter().filter_map(|plate| stepped_weight(&plate.times, &vertical(plate))));
        let unit = stepped.and_then(|stepped| ForceUnit::of_steps(stepped / assumed_n, Some(weight_n)));
        let Some((unit, newtons)) = unit.and_then(|unit| Some((unit, unit.newtons(Some(weight_n))?))) else {
            return self;
        };
        if (newtons / assumed_n - 1.0).abs() > 1e-9 {
            plates.iter_mut().for_each(|plate| *plate = plate.with_unit(newtons / assumed_n));
            let message = format!(
                "with the known mass, the forces of the plates are in {} (a step weighs {:.0} N); they were read so",
                unit.name(),
                stepped.unwrap_or(f64::NAN) * newtons / assumed_n
            );
            findings.withdraw(Code::PlatesUnitByWeight, |_| true);
            findings.report(Code::PlatesUnitByWeight, message);
        }
        self
    }

    /// Measurements of the person, for the built-in body.
    fn person(&self, settings: &Settings) -> Result<calibration::PersonMeasurements, StudyError> {
        let MarkerBody::BuiltIn { table, mass_kg, height_m, .. } = &self.body else {
            return Err(StudyError::MassUnknown);
        };
        Ok(calibration::PersonMeasurements {
            table: *table,
            mass: mass_kg.ok_or(StudyError::MassUnknown)?,
            height: height_m.or_else(|| self.stated(|file| file.subject.height_m)),
            measurements: BodyMeasurements {
                joints: JointCentres { hip: settings.hip, knee_axis: settings.knee_axis, ..JointCentres::default() },
                ..self.measurements()
            },
        })
    }

    /// Widths and lengths that the files state.
    pub(super) fn measurements(&self) -> BodyMeasurements {
        BodyMeasurements::from_processing(|name| self.stated(|file| file.subject.processing(name)))
    }

    /// A value that the standing trial states, or the trial if the standing trial does not.
    fn stated(&self, of: impl Fn(&LaboratoryFile) -> Option<f64>) -> Option<f64> {
        self.standing.as_ref().and_then(|standing| of(standing)).or_else(|| of(&self.trial))
    }
}

/// The forces of a table; none if the table never carries a load: they are then predicted.
fn carrying(found: TableForces, findings: &mut Findings) -> (Vec<ForceRecording>, IdleForces) {
    let idle = IdleForces::of_table(&found);
    idle.report(findings);
    let is_predicted = !found.forces.iter().any(is_loaded);
    (if is_predicted { Vec::new() } else { found.forces }, idle)
}

/// The forces of the file's plates on the feet; a note where there are none.
fn plate_forces(body: &BodyInMotion, findings: &mut Findings) -> Vec<ForceRecording> {
    let forces = body.plate_forces();
    if forces.is_empty() {
        let message = format!("{}: the ground forces are predicted from the motion", without_forces(body));
        findings.report(Code::GroundPredicted, message);
    }
    forces
}

/// Why the plates of a file give no forces on the feet.
fn without_forces(body: &BodyInMotion) -> String {
    let contacts = &body.on_plates.contacts;
    let one =
        |c: &PlateContact| format!("{}, {:.3}-{:.3} s: {}", body.plates[c.plate].name, c.start_s, c.end_s, c.reason);
    match contacts.first() {
        _ if body.plates.is_empty() => "the file has no force plates".to_owned(),
        None => format!("no load was measured on the file's {}", counted(body.plates.len(), "force plate")),
        Some(_) if body.subject.model.anatomy().feet().is_none() => {
            "the model has no two legs with hip, knee, ankle and foot".to_owned()
        }
        Some(first) => format!("no plate's load belongs to one foot ({})", one(first)),
    }
}

fn counted(count: usize, one: &str) -> String {
    format!("{count} {one}{}", if count == 1 { "" } else { "s" })
}
