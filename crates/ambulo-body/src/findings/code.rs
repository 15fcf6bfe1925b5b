//! The list of all findings: name, severity, meaning and remedy of each.
//!
//! docs/FINDINGS.md is written from this list.

use super::Severity;
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use std::fmt;

/// The name, severity and meaning of a code.
struct Entry {
    code: Code,
    name: &'static str,
    severity: Severity,
    meaning: &'static str,
    remedy: &'static str,
}

/// Makes the enum and the list of entries, in the same order. A macro, because no function can declare the variants of
/// an enum.
macro_rules! codes {
    ($($variant:ident $name:literal $severity:ident $meaning:literal $remedy:literal;)*) => {
        /// What a finding is about. Its name, such as `markers.swap`, is stable and meant for programs.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Code {
            $(#[doc = $meaning] $variant,)*
        }

        /// One entry per code, in the order of the enum.
        static ENTRIES: &[Entry] = &[
            $(Entry {
                code: Code::$variant,
                name: $name,
                severity: Severity::$severity,
                meaning: $meaning,
                remedy: $remedy,
            },)*
        ];
    };
}

codes! {
    // Models.
    ModelDocument "model.document" Warning
        "The version of the model file is not one of the known versions."
        "Check the results, or save the model in a known version with OpenSim.";
    ModelIgnored "model.ignored" Note
        "Forces, controllers and geometry of the model are not used."
        "Nothing to do.";
    ModelMassless "model.massless" Warning
        "A body of the model has no mass."
        "Check the mass of the body; zero is correct only if another body includes its mass.";
    ModelInertia "model.inertia" Warning
        "The inertia of a body is physically impossible."
        "Correct the inertia in the model file: moments of inertia are positive, and none exceeds the sum of the other \
         two.";
    ModelBushing "model.bushing" Note
        "A bushing (a spring with a damper between two bodies) is included in inverse dynamics; forces of the \
         coordinates are in addition to it."
        "Nothing to do; to leave it out, switch it off in the model or exclude it in the set-up of inverse dynamics.";
    ModelConstraint "model.constraint" Warning
        "A constraint of the model is not enforced; forces that pass through it are reported at the joints of the tree."
        "Interpret forces of the joints around the constraint with care, or use a model without it.";
    // Muscles.
    MusclesUnsupported "muscles.unsupported" Warning
        "Muscles of a type that is not supported, or that wrap over a surface of such a type, were left out."
        "Interpret forces of the other muscles with care: they do the work of those left out. Supported are \
         Thelen2003Muscle and Millard2012EquilibriumMuscle, over cylinders and spheres.";
    MusclesOff "muscles.off" Note
        "Muscles that are switched off in the model were left out."
        "Nothing to do; to use them, set `appliesForce` in the model.";
    MusclesNoJoint "muscles.no_joint" Warning
        "The path of a muscle crosses no joint that moves; the muscle was left out."
        "Check the bodies of its points in the model.";
    MusclesNoStrength "muscles.no_strength" Warning
        "A muscle has no strength and was left out."
        "Check its greatest isometric force in the model.";
    MusclesInsideWrap "muscles.inside_wrap" Warning
        "The path of a muscle has an end inside a surface over which it should wrap; it runs straight there."
        "Move the point or the surface in the model; lengths and moment arms of the muscle are wrong there.";
    MusclesReserves "muscles.reserves" Warning
        "The muscles are too weak for a moment: motors add more than a tenth of the largest one at this coordinate."
        "Check the strength of the muscles and the moments; forces of the muscles there are too small by what the \
         motors add.";
    MusclesUnmet "muscles.unmet" Warning
        "Muscles and motors together cannot give the moments in some frames."
        "Give motors without limits to the coordinates that lack one; forces in these frames do not balance the \
         motion.";
    MusclesAvailable "muscles.available" Note
        "The model has muscles; their forces are computed on request."
        "Ask for muscle forces to get activations, tensions and the loads of the joints.";
    EmgUnused "emg.unused" Warning
        "The electromyograms of the recording cannot be used."
        "Check the channels, or give a table of electromyograms.";
    EmgSilent "emg.silent" Note
        "Channels with the name of a muscle hold no signal of one."
        "Nothing to do if no electrode was there.";
    // Input files.
    FileOdd "file.odd" Warning
        "A file deviates from its format; it was read with the assumption in the message."
        "Check the assumption, or export the file again.";
    FileUnitGuessed "file.unit_guessed" Warning
        "The file states no unit of length; it was inferred from the size of the person or of the force plates."
        "Check the stature in the result, or set the unit in the file.";
    // Recorded coordinates.
    MotionUnitUnstated "motion.unit_unstated" Warning
        "The file does not state whether its angles are in degrees or radians; they were read as radians, or as \
         degrees if \
         they are too large for radians."
        "Add `inDegrees=yes` or `inDegrees=no` to the header.";
    MotionDegreesAsRadians "motion.degrees_as_radians" Warning
        "Angles were read as radians, but they are as large as angles in degrees."
        "Set `inDegrees=yes` in the header of a `.mot` or `.sto` file; a `.csv` file cannot state its unit.";
    MotionRadiansAsDegrees "motion.radians_as_degrees" Warning
        "Angles were read as degrees, but they are as small as angles in radians."
        "Set `inDegrees=no` in the header.";
    MotionLengthUnit "motion.length_unit" Warning
        "Positions that should be in metres are as large, or change as fast, as positions in millimetres or \
         centimetres."
        "State the unit of the positions, or convert them to metres.";
    MotionUnwrapped "motion.unwrapped" Note
        "An angle jumps by a whole turn between two frames; the turns were removed."
        "Nothing to do.";
    MotionJump "motion.jump" Warning
        "A coordinate jumps between two frames; rates and forces are wrong there."
        "Correct these frames, or leave them out.";
    MotionUnknownCoordinate "motion.unknown_coordinate" Warning
        "Columns of the recording match no coordinate of the model; they were not used."
        "Check that recording and model belong together, or rename the columns.";
    MotionMissingCoordinate "motion.missing_coordinate" Warning
        "The recording has no column for coordinates of the model; their default values were used throughout."
        "Record these coordinates, or check that their constant values suit the motion.";
    MotionCoupledMismatch "motion.coupled_mismatch" Warning
        "Recorded values of a coordinate differ from those of its coupler, or those of a coordinate that the model \
         determines have gaps; the model's values were used."
        "Check that recording and model belong together.";
    MotionModelReplaced "motion.model_replaced" Warning
        "Recorded values of a coordinate that the model locks or prescribes differ from those of the model; the \
         recorded \
         values were used, as in OpenSim's inverse dynamics."
        "Check that recording and model belong together; without the column, the values of the model are used.";
    MotionOutOfRange "motion.out_of_range" Warning
        "A coordinate leaves the range that the model allows."
        "Check that the motion was recorded with this model, and that signs agree: some models count knee flexion \
         positive, some negative.";
    MotionRepeatedRow "motion.repeated_row" Warning
        "Rows of the recording repeat the row before them and were dropped."
        "Check the export of the file.";
    MotionUnevenClock "motion.uneven_clock" Warning
        "Samples of the recording are not evenly spaced in time; the recording was resampled."
        "Check for dropped frames.";
    MotionHeldFrames "motion.held_frames" Warning
        "Frames repeat the frame before them exactly while the body moves: the recording was played back, resampled or \
         frozen by a program. They were treated as gaps."
        "Export the recording again at the rate at which it was made.";
    MotionGapFilled "motion.gap_filled" Warning
        "Missing samples were filled by a spline."
        "Check the filled stretches, or fill them in the program that made the recording.";
    MotionShorterThanScene "motion.shorter_than_scene" Warning
        "A motion that drives a scene ends before the scene; its last values are kept until the end."
        "Shorten the scene or lengthen the motion.";
    MotionClock "motion.clock" Warning
        "The stated frame rate is contradicted by gravity in flight, by the balance of the body over its feet, or by \
         the times in the file; every force depends on it."
        "Correct the frame rate in the file; the message states what it looks like.";
    // Skeletons.
    BvhAxes "bvh.axes" Note
        "States which axes of the skeleton file are up and forward."
        "Nothing to do if the axes are right.";
    BvhUpUnsure "bvh.up_unsure" Warning
        "The upward axis of the skeleton file is not clear from the posture."
        "Check that the figure stands upright in the result.";
    BvhUnit "bvh.unit" Warning
        "The unit of length of the skeleton file was guessed, and the resulting body size is unusual."
        "Give the person's stature.";
    BvhJointsMissing "bvh.joints_missing" Warning
        "Useful joints were not recognised by their names."
        "Rename the joints of the skeleton to usual names.";
    BvhRestPose "bvh.rest_pose" Note
        "The rest pose of the file is not upright standing; a T- or A-pose of the recording, or its mean posture, is \
         used instead."
        "Nothing to do if the message names a pose; otherwise check that the person is upright on average.";
    BvhPose "bvh.pose" Note
        "The first frame is a calibration pose and was left out."
        "Nothing to do.";
    BvhFloor "bvh.floor" Note
        "The floor was placed at the height where the ankles are lowest."
        "Nothing to do if the person stands on flat ground.";
    BvhLengths "bvh.lengths" Note
        "Segment lengths of the skeleton are unusual."
        "Check the skeleton: forces depend on the lengths of its segments.";
    BvhLowTrust "bvh.low_trust" Warning
        "A skeleton file has no mass, no unit and mostly filtered motion: forces are estimates for comparison only."
        "Use markers or joint coordinates if accurate forces are needed.";
    // Motions of the SMPL family.
    SmplBody "smpl.body" Note
        "States where the lengths of a motion of the SMPL family come from."
        "Give the SMPL model that the motion was made with, or the person's stature.";
    // Subjects of AddBiomechanics.
    B3dForceMissing "b3d.force_missing" Warning
        "Ground forces are marked as missing in some frames; only the longest time with measured forces was used, or \
         forces were predicted."
        "Choose another time range, or predict the forces of the whole trial.";
    B3dUnobserved "b3d.unobserved" Note
        "Coordinates of the model were not measured in this trial; their values are assumed."
        "Do not use the moments of these joints.";
    B3dFiltered "b3d.filtered" Note
        "The motion in the file was filtered before."
        "Nothing to do, or switch the filter of the motion off.";
    B3dStatedMass "b3d.stated_mass" Warning
        "The stated mass differs from the mass of the model in the file; forces are computed with the model."
        "Give the mass of the person; the model is then scaled to it.";
    B3dFormDefaults "b3d.form_defaults" Warning
        "Stated mass, stature and age equal the default values of the AddBiomechanics form."
        "Give the mass of the person if it is known.";
    // Orientations of sensors.
    SensorsFitted "sensors.fitted" Note
        "The body was fitted to orientations of sensors; the message states the remaining angles."
        "Check the sensor with the largest angle; it may have moved on the body.";
    SensorsHeading "sensors.heading" Note
        "The orientations of the sensors were turned about the vertical, so that the person faces forward."
        "Check that the person walks forward in the result; an axis of a sensor that points forward can show the \
         direction instead.";
    SensorsHeld "sensors.held" Note
        "Coordinates that rotate no sensor keep their default values."
        "Nothing to do; toes and wrists are often without sensors.";
    SensorsMissing "sensors.missing" Warning
        "A sensor has no data in some frames."
        "Check the sensor; short gaps are bridged, longer ones leave coordinates unknown.";
    SensorsPlaced "sensors.placed" Warning
        "Orientations do not contain the position of the person; the position of the pelvis was derived from the feet \
         on the ground."
        "Treat horizontal forces, speed and step lengths as estimates; do not use recordings of running, jumping or \
         stairs.";
    SensorsUnknown "sensors.unknown" Warning
        "Sensors match no body of the model, or several match the same body."
        "Name the columns by the bodies of the model, with the ending `_imu`.";
    SensorsUnrest "sensors.unrest" Warning
        "The person moves during the time for which the default posture of the model is assumed."
        "Record the person standing still in the default posture of the model, and give that as the standing trial.";
    // Poses of segments.
    PosesUsed "poses.used" Note
        "The file contains poses of body segments (markerless motion capture or an inertial suit); the body follows \
         them, and markers of the file are not used."
        "Nothing to do.";
    PosesOdd "poses.odd" Warning
        "Poses of segments are not valid rotations, are missing, or do not agree with a level floor."
        "Check the export of the file.";
    PosesAssumed "poses.assumed" Note
        "Segment lengths and masses that the poses do not contain were assumed."
        "Give the stature; check that the floor is at height zero.";
    PosesLengths "poses.lengths" Note
        "Distances between the joint centres of the poses are unusual."
        "Check the unit of length and the stature.";
    PosesGap "poses.gap" Warning
        "Poses of a segment are missing for longer than the largest gap that is bridged; its coordinates have no value \
         there."
        "Choose a time range without the gap.";
    PosesBridged "poses.bridged" Note
        "Missing poses of a segment were bridged by a smooth curve."
        "Nothing to do for short gaps.";
    // The laboratory's axes and units.
    LaboratoryAxes "laboratory.axes" Note
        "States which axes of the laboratory are up and forward."
        "Nothing to do if the axes are right.";
    LaboratoryUpContradicted "laboratory.up_contradicted" Warning
        "Markers and force plates disagree on which axis is up; the markers were used."
        "Check the corners of the force plates in the file.";
    LaboratoryUpUnclear "laboratory.up_unclear" Warning
        "Neither a force plate nor the posture shows which axis is up."
        "Name heel, toe and pelvis markers as a marker set does.";
    LaboratoryForwardUnclear "laboratory.forward_unclear" Warning
        "The forward direction is not clear: the body does not travel, and heel, toe and pelvis markers are missing or \
         point in different directions."
        "Name heel, toe and pelvis markers as a marker set does; check whether left and right are exchanged.";
    LaboratoryBackwards "laboratory.backwards" Warning
        "The body walks backwards; forward is the direction that it faces."
        "Check left and right markers if the person walked forwards.";
    LaboratorySideways "laboratory.sideways" Warning
        "The body does not walk in the direction that it faces; forward is the direction that it faces."
        "Check whether left and right markers are exchanged.";
    LaboratoryTurning "laboratory.turning" Warning
        "The body turns, so one forward direction does not suit the whole recording."
        "Interpret angles of the pelvis and fore-aft forces with care, or choose a straight part of the recording.";
    LaboratoryUnitChanged "laboratory.unit_changed" Warning
        "With the unit in the file, the height of the markers is impossible; lengths were rescaled."
        "Correct the unit in the file.";
    LaboratorySizeOdd "laboratory.size_odd" Warning
        "The height of the markers is not that of a standing person, and a wrong unit does not explain it."
        "Check the unit of the file, and whether markers are not on the person.";
    // Markers.
    MarkersDrawn "markers.drawn" Warning
        "A marker follows a straight line at constant speed while the others do not: a gap was filled by a line. These \
         samples were treated as gaps."
        "Leave gaps open, or fill them from other markers of the segment.";
    MarkersHeldInPlace "markers.held_in_place" Warning
        "A marker, a sensor or a segment stays exactly in place while the others move: a program filled a gap by \
         holding its last sample. These samples were treated as gaps."
        "Fill these gaps by another method, or leave them open.";
    MarkersZeroIsGap "markers.zero_is_gap" Warning
        "Positions of exactly 0 0 0 were read as gaps."
        "Export gaps as missing values.";
    MarkersImpossible "markers.impossible" Warning
        "Positions very far from the origin were read as gaps."
        "Check the export of the file.";
    MarkersNameTwice "markers.name_twice" Warning
        "Two points have the same name; the one that is present for longer was used."
        "Give every marker a different name.";
    MarkersUncommon "markers.uncommon" Note
        "Only markers that are in both the recording and the model are fitted."
        "To use more markers, name them as in the model.";
    MarkersByMotion "markers.by_motion" Note
        "Markers without a known name, or that the standing trial lacks, were given to the segments with which they \
         move."
        "Nothing to do if the segments are right; otherwise give these markers a meaning in a marker set.";
    MarkersByPlace "markers.by_place" Warning
        "The known names do not suffice for a body; markers with other names were taken by their places on it."
        "Check the landmarks in the message, and give these markers their meaning in a marker set.";
    MarkersUnused "markers.unused" Warning
        "The body follows fewer than 60 % of the markers of the motion."
        "Give the other markers a meaning in a marker set; names of points that are not on the body can be left out.";
    MarkersSegmentHardlyShown "markers.segment_hardly_shown" Warning
        "A thigh or shank has no marker of the joint at its lower end and fewer than three others in the motion."
        "Leave the markers of knees and ankles on the body, or put three markers on each thigh and shank, and record \
         them in the standing trial too.";
    MarkersEnds "markers.ends" Note
        "Frames at the ends with less than half of the markers were left out."
        "Nothing to do.";
    MarkersMissing "markers.missing" Note
        "A marker is missing at some times."
        "Nothing to do; the other markers determine the posture there.";
    MarkersJump "markers.jump" Warning
        "A marker moved away from its position on the body at some times and was not used there."
        "Correct the trajectory of the marker.";
    MarkersUnfitted "markers.unfitted" Warning
        "The fit of the body to the markers took too many steps at some times and was stopped; coordinates are \
         approximate there, or have no values."
        "Correct markers that jump or have wrong labels, or leave those times out.";
    MarkersRefitted "markers.refitted" Note
        "The body did not follow the markers at first; another start was used, or all frames were fitted together."
        "Check the distances of the markers; correct markers that jump or have wrong labels.";
    MarkersSwap "markers.swap" Warning
        "Two markers had exchanged labels at some times, or in a whole recording, and were exchanged back."
        "Correct the labels.";
    MarkersMisplaced "markers.misplaced" Warning
        "A marker is far from its position on the body throughout; its weight was reduced."
        "Check whether it moved after the standing trial or has another marker's label.";
    MarkersBridged "markers.bridged" Note
        "Too few markers determine a coordinate at some times; a smooth curve fills the gap."
        "Interpret the coordinate with care there.";
    MarkersGap "markers.gap" Warning
        "Too few markers determine a coordinate for too long; it has no value there."
        "Fill the markers' trajectories, or allow longer gaps.";
    MarkersHeld "markers.held" Note
        "No marker determines some coordinates of the body; constant values are used."
        "Add markers on the named segments if these coordinates matter.";
    MarkersNotMeasured "markers.not_measured" Warning
        "A coordinate of a leg or the pelvis was not measured: nothing recorded determines it, so that it keeps one \
         value, or it lies on its limit in more than a tenth of the frames. Clinical tables and scores leave it out."
        "Record all markers of the segment in the motion and in the standing trial; at a limit, check for misplaced or \
         exchanged markers.";
    MarkersTrunk "markers.trunk" Warning
        "The markers of trunk and head are far from the body, while those of pelvis and legs fit: residuals and \
         predicted ground forces are uncertain, moments of the legs from measured ground forces are not."
        "Check the markers of the trunk: whether one moved after the standing trial or has another marker's label.";
    MarkersArms "markers.arms" Warning
        "The markers of the arms are far from the body, while those of pelvis and legs fit."
        "Nothing to do for the forces of the legs; for those of the arms check their markers in the standing trial.";
    MarkersSidesExchanged "markers.sides_exchanged" Warning
        "Left and right are exchanged in all labels of a recording, so that the person is mirrored; they were \
         exchanged \
         back."
        "Correct the labels. If the axes of the laboratory are left-handed, mirror one axis instead: the sides of all \
         results are then exchanged.";
    MarkersMoved "markers.moved" Warning
        "A marker is elsewhere on the body than in the standing trial, while the others agree: it moved, or was put on \
         anew."
        "Record a standing trial with the markers of the motion, or leave out the standing trial; which of the two \
         recordings is right cannot be decided.";
    MarkersWindow "markers.window" Warning
        "Markers are missing for too long outside a part of the recording; only this part was analysed."
        "Allow longer gaps, or choose another part of the recording.";
    MarkersTask "markers.task" Warning
        "A coordinate with a target value in the marker fit is not in the model, or no marker moves with it."
        "Correct the name of the coordinate, or leave the task out.";
    // The body.
    CalibrationAssumed "calibration.assumed" Note
        "States an assumption that was made to build the body from the markers."
        "Give stature, mass or a standing trial if they are available.";
    CalibrationNotStanding "calibration.not_standing" Warning
        "The person moves in most of the standing trial; all of its frames were used."
        "Use a trial in which the person stands still, or no standing trial.";
    CalibrationMovement "calibration.movement" Note
        "A movement of the person shows the centre of a hip or the axis of a knee, which the body has."
        "Nothing to do.";
    CalibrationMovementRefused "calibration.movement_refused" Warning
        "The movement does not show the centre of a hip or the axis of a knee; that of the markers was used."
        "Record a movement of the hips in two planes, of at least 20 degrees each, and of the knees, of at least 45 \
         degrees, with two markers on each thigh and shank.";
    CalibrationKneeAxis "calibration.knee_axis" Note
        "The axis of a knee was chosen by the least cross-talk."
        "Nothing to do.";
    CalibrationCrossTalk "calibration.cross_talk" Warning
        "Varus of a knee follows its flexion: the axis that its markers show is not that about which it bends."
        "Check the markers of the epicondyles and the wand of the thigh, find the axis by a movement, or choose the \
         axis \
         with the least cross-talk.";
    CalibrationOtherPerson "calibration.other_person" Warning
        "Standing trial and recording name different persons; the standing trial was used."
        "Give the standing trial of this person, or correct the name of the subject in the files.";
    CalibrationPlaced "calibration.placed" Warning
        "The standing trial lacks a marker of a leg or the pelvis that the motion has; its place on the body was taken \
         from the motion."
        "Nothing to do if the angles of this segment are plausible; otherwise record a standing trial with all \
         markers.";
    CalibrationOtherLimbs "calibration.other_limbs" Warning
        "The limbs of the standing trial have other lengths than those of the motion: it is another person's."
        "Give the standing trial of this person, or none.";
    CalibrationTrunkUpright "calibration.trunk_upright" Note
        "The trunk has no marker; it is assumed upright above the pelvis."
        "Add markers on the trunk.";
    CalibrationArmsSwing "calibration.arms_swing" Note
        "An arm has too few markers; it is assumed to swing against the leg of its side."
        "Add markers on shoulders, elbows and wrists.";
    KeypointsNoise "keypoints.noise" Note
        "The recording has keypoints of video instead of markers; their noise was estimated, and positions far from \
         their paths were left out."
        "Nothing to do; more cameras or a better calibration of the cameras reduce the noise.";
    ScalingFitted "scaling.fitted" Note
        "States how the model was scaled to the person and how well its markers fit."
        "Nothing to do.";
    ScalingMoving "scaling.moving" Warning
        "Markers move in the standing trial; their mean positions were used."
        "Use a trial in which the person stands still.";
    ScalingPair "scaling.pair" Warning
        "A scaling measurement was not used, because a marker of its pairs is missing in the model or the trial."
        "Correct the names of the pair, or leave the measurement out.";
    ScalingBody "scaling.body" Warning
        "Scaling names a body that the model does not have."
        "Correct the name of the body, or leave it out.";
    ScalingUnseen "scaling.unseen" Note
        "Markers of the model that the standing trial does not have were removed from the scaled model."
        "Nothing to do, unless the names of these markers differ in the trial.";
    // Set-ups of OpenSim's tools.
    SetupUnused "setup.unused" Note
        "A part of a set-up of OpenSim was not used."
        "Check that the results do not depend on it.";
    SetupReplaced "setup.replaced" Note
        "An option replaced a value of a set-up of OpenSim."
        "Leave the option out to use the set-up as it is.";
    SubjectNotWritten "subject.not_written" Note
        "The body could not be written as `subject.osim`."
        "The message states the reason; all other results are complete.";
    // Body mass.
    MassStanding "mass.standing" Note
        "The body mass was measured by force plates in the standing trial."
        "Nothing to do.";
    MassWeighed "mass.weighed" Note
        "No mass is stated; it was measured by the force plates during the motion."
        "Nothing to do, or state the mass.";
    MassMismatch "mass.mismatch" Warning
        "The mass on the force plates over whole gait cycles differs from the mass of the model by 3 to 5 %: results \
         are normalised by the measured mass, dynamics use the mass of the model."
        "Scale the model to this person.";
    MassStandingMismatch "mass.standing_mismatch" Warning
        "The stated body mass was not used: the standing trial and the motion on the force plates agree on a different \
         mass."
        "Give the measured mass, or check the standing trial.";
    MassContradicted "mass.contradicted" Warning
        "The mass on the force plates, in motion or in the standing trial, differs from the body mass by more than 5 % \
         and more than the error of the measurement."
        "Give the right mass, or scale the model to this person; check that every foot is on a plate.";
    MassReplaced "mass.replaced" Warning
        "Force plates carry another mass than the model has, and none is stated; the masses of the model were scaled \
         to \
         the weighed one."
        "State the body mass if the weighed one is wrong; the mass of the model keeps the model as it is.";
    MassScaled "mass.scaled" Note
        "The model was scaled to the stated mass and stature."
        "Nothing to do.";
    MassStatedTwice "mass.stated_twice" Warning
        "The given body mass is not the one that the recording states, and no force plate decides; the given one was \
         used."
        "Give the mass in kilograms, or correct the one in the file.";
    MassUnusual "mass.unusual" Warning
        "Mass and stature give a body mass index that people who walk do not have: mass, stature or the unit of the \
         force plates is wrong."
        "Check mass [kg] and stature [m], and the unit and the amplifier of the force plates.";
    MassUnverified "mass.unverified" Warning
        "The body mass is neither given nor measured; every force is proportional to it."
        "Give the mass or a standing trial on force plates.";
    // Force plates.
    PlatesUnusable "plates.unusable" Warning
        "A force plate was left out."
        "The message states what is missing or wrong in the file.";
    PlatesExcursion "plates.excursion" Warning
        "A channel of a force plate or a force of a table jumps away from its course and back within 50 ms, which no \
         load does. Straight lines were drawn instead, also in channels that fail with it."
        "Look for a loose cable; the force there is an interpolation.";
    PlatesLost "plates.lost" Warning
        "A force plate or a force of a table lost its signal for longer than 50 ms: it stays at one level between \
         jumps, \
         keeps its values, jumps and does not return, or has no rows. The force there is not known."
        "Look for a loose cable, lost packets or rows that were deleted; the message says what was drawn instead.";
    PlatesStillChannel "plates.still_channel" Warning
        "A channel of a loaded force plate, or a component of a force of a table, has one value all the time, so a \
         part of the force is missing."
        "Check cables, amplifier and the order of the channels in the file.";
    PlatesOriginTurned "plates.origin_turned" Note
        "ORIGIN of a plate has the opposite sign, a usual error of programs, and was reversed."
        "Nothing to do.";
    PlatesUnitChanged "plates.unit_changed" Warning
        "With the unit in the file, the size of the force plates is impossible; their lengths were rescaled."
        "Correct the unit in the file.";
    PlatesUnitUnknown "plates.unit_unknown" Warning
        "The unit of a force is unknown; it was read as newtons."
        "Correct the unit in the file.";
    PlatesUnitByWeight "plates.unit_by_weight" Warning
        "By the unit in the file, steps on the plates weigh what no person does; another unit fits and was used."
        "Correct the unit, the scale or the calibration of the channels in the file.";
    PlatesPolynomial "plates.polynomial" Note
        "The file has a polynomial that corrects the centre of pressure; it was not used."
        "Nothing to do; the correction is some millimetres.";
    PlatesForceOnPlate "plates.force_on_plate" Warning
        "The file contains the force of the foot on the plate; all signs of the plate were reversed."
        "Nothing to do if the vertical force is now upward.";
    PlatesNoCalibration "plates.no_calibration" Warning
        "A plate of this type has no calibration matrix; its channels were used as they are."
        "Add the calibration matrix to the file.";
    PlatesNoSensorDistance "plates.no_sensor_distance" Warning
        "The file does not state where the sensors of a plate are; its moments and centre of pressure are meaningless."
        "Add ORIGIN of the plate to the file.";
    PlatesBaseline "plates.baseline" Note
        "An unloaded plate measured a small force; it was subtracted."
        "Nothing to do.";
    PlatesLargeBaseline "plates.large_baseline" Warning
        "An unloaded plate measured a large force; it was subtracted."
        "Zero the plates before recording.";
    PlatesClipped "plates.clipped" Warning
        "A channel of a plate reached the end of its range; the force is too small there."
        "Choose a larger range of the amplifier.";
    PlatesReadingChanged "plates.reading_changed" Warning
        "The centre of pressure is impossible with the stated units; other units were assumed."
        "Correct the units in the file.";
    PlatesCenterOutside "plates.center_outside" Warning
        "The centre of pressure is often outside its plate."
        "Check CORNERS, ORIGIN, CHANNEL and the units of the plate in the file.";
    PlatesCornersOrdered "plates.corners_ordered" Warning
        "With the corners in the order of the file the loads of a plate lie beside the feet, with another order under \
         them; the other order was used."
        "Correct FORCE_PLATFORM:CORNERS in the file.";
    PlatesCornersUnclear "plates.corners_unclear" Warning
        "The loads of a plate lie beside the feet; several orders of its corners put them under the feet, and none was \
         used."
        "Correct FORCE_PLATFORM:CORNERS in the file, or state how the plate is turned.";
    PlatesMirrored "plates.mirrored" Warning
        "A horizontal force of a plate or a force table points away from the mass centre where it must point towards \
         it: it is mirrored or turned."
        "State the correction of the plate, or correct the sign of the channel or column.";
    PlatesShearGain "plates.shear_gain" Warning
        "The fore-aft force of a plate or a force table is too large or too small, by its direction and by the \
         acceleration of the mass centre."
        "Check sensitivity and calibration matrix of the channels.";
    PlatesUnequal "plates.unequal" Warning
        "Two plates measure different shares of the vertical force that the motion needs."
        "Check the calibration of both with a known weight; look for a cane or a handrail.";
    PlatesSkewed "plates.skewed" Warning
        "The horizontal force of a plate or a force table is turned by some degrees, by its direction and by the \
         acceleration of the mass centre."
        "Correct FORCE_PLATFORM:CORNERS in the file, or the axes of the force table.";
    PlatesMisplaced "plates.misplaced" Warning
        "The centres of pressure lie to one side of both feet, or not where the motion needs them along the foot: \
         plates or markers are not where the file states, or moments of a plate are wrong."
        "Correct FORCE_PLATFORM:CORNERS in the file, or the places of the force table.";
    PlatesCrossTalk "plates.cross_talk" Warning
        "A plate shows a small load under no foot while another plate is loaded: cross-talk; it was left out."
        "Check cables and amplifiers of the plates.";
    PlatesPartial "plates.partial" Warning
        "Only part of a foot's load was measured."
        "Choose a step that is wholly on a plate.";
    PlatesTwoFeet "plates.two_feet" Warning
        "Two feet were on one plate at the same time; this load was assigned to neither foot."
        "State the foot of the plate, if all of the load belongs to one.";
    PlatesSilent "plates.silent" Warning
        "A force plate, or a whole force table, has no load although feet were on the ground there."
        "Check that the plate was switched on and that the forces belong to this trial, or leave the plate out.";
    PlatesUnassigned "plates.unassigned" Warning
        "The load of a plate could not be assigned to a foot."
        "State the foot of the plate.";
    PlatesShared "plates.shared" Note
        "One foot was on two plates at the same time; both forces were added."
        "Nothing to do.";
    PlatesNoWindow "plates.no_window" Warning
        "There is no time with every loaded foot wholly on a plate: totals and forces at the pelvis cannot be judged."
        "Record steps on plates, or predict the forces.";
    // Loads from files.
    LoadsGuessed "loads.guessed" Note
        "The columns of the ground forces were recognised by their names, the feet by names or by the centre of \
         pressure."
        "State them if the guess is wrong.";
    LoadsWorldAxes "loads.world_axes" Note
        "Forces from a table are not in the markers' axes; they are read as x forward, y up, z right."
        "Rotate the forces of the table if their axes are different.";
    LoadsTurned "loads.turned" Warning
        "The forces of a table do not act along y, upwards, but along another axis: the table has other axes; it was \
         turned."
        "Turn the table so that y is up and x forward, or say so to the program that wrote it.";
    LoadsUnitByWeight "loads.unit_by_weight" Warning
        "Steps in a force table weigh what no person does in newtons, or its moments are too large for N.m; another \
         unit fits and was used."
        "Write newtons, metres and newton metres.";
    LoadsSwitchedOff "loads.switched_off" Note
        "A load is switched off in its file and was not used."
        "Nothing to do.";
    LoadsMillimetres "loads.millimetres" Warning
        "A load acts so far from the origin that its points appear to be in millimetres."
        "Divide the points by 1000, and the moments too if they are in N.mm.";
    LoadsLightPoint "loads.light_point" Warning
        "Points of a load lie far from the foot where it carries little; they were held at the nearest point of a \
         solid \
         load."
        "Filter forces and moments first, and compute points then; leave rows without a point empty.";
    LoadsPointUndefined "loads.point_undefined" Note
        "A load has no point of application, or no force, while it is unloaded; it was read as zero."
        "Nothing to do.";
    LoadsShorterThanMotion "loads.shorter_than_motion" Note
        "Forces were recorded for a part of the motion only; the rest was left out."
        "Nothing to do.";
    ForcesDelayed "forces.delayed" Warning
        "The measured forces are late or early against the motion by more than 10 ms and one frame: both residual \
         force \
         and residual moment fall by a tenth or more if the forces are shifted."
        "Synchronise plates and cameras, or shift the forces by the delay in the message.";
    LoadsNoSide "loads.no_side" Warning
        "A load acts on a body that is neither left nor right; it is used, but not in `grf.mot`."
        "Check the body on which the load acts.";
    LoadsSeveralBodies "loads.several_bodies" Note
        "Loads act on several bodies of one side; `grf.mot` contains their sum."
        "Nothing to do.";
    LoadsDownward "loads.downward" Warning
        "A ground force points down; it appears to be the force of the foot on the plate."
        "Change the sign of forces and torques.";
    LoadsFarFromFoot "loads.far_from_foot" Warning
        "A force acts nearer to the other foot than to its own; right and left may be exchanged."
        "Exchange the bodies on which the loads act.";
    LoadsUnderOtherFoot "loads.under_other_foot" Warning
        "The centre of pressure of a load is under the other foot than stated by its file or its name; it was used as \
         stated."
        "Correct the body of the load, or remove it, so that the centre of pressure decides.";
    LoadsOtherHeight "loads.other_height" Warning
        "The foot on which a load of a force table acts is far above or below its centre of pressure."
        "Check that forces and motion have the same origin; on stairs, that the points have the height of their step.";
    LoadsUnassigned "loads.unassigned" Warning
        "A load of a force table is near neither foot and was left out at this time."
        "State the foot, or check that forces and motion have the same origin and clock.";
    // Devices.
    DeviceShorterThanMotion "device.shorter_than_motion" Warning
        "The device was recorded for a part of the motion only; elsewhere its contribution is zero."
        "Choose the time in which the device was recorded.";
    DeviceUnknownColumn "device.unknown_column" Warning
        "A column of the device's table is not a generalised force of the model; it was not used."
        "Name columns as in `moments.sto`.";
    // Events and cycles.
    EventsNotUsed "events.not_used" Note
        "An event of the file is neither a foot strike nor a foot off of a side; it was not used."
        "Nothing to do.";
    EventsContradicted "events.contradicted" Warning
        "The foot strikes and foot offs that the file lists contradict the force plates: right and left are exchanged, \
         or they are early or late. They were not used."
        "Correct the events in the file.";
    EventsNoFootMarkers "events.no_foot_markers" Note
        "A foot has no marker on heel or toe, so its events cannot be detected from motion."
        "Put markers on heel and toe of both feet.";
    EventsColumns "events.columns" Note
        "States which columns were read as the upward forces of the feet."
        "Nothing to do if they are right.";
    EventsNone "events.none" Note
        "No foot strike was detected."
        "Check the range, and the threshold of force if forces were measured.";
    CyclesNone "cycles.none" Note
        "No whole gait cycle was recorded, so results per cycle are not written."
        "Record two foot strikes of the same foot.";
    CyclesOtherFootUnseen "cycles.other_foot_unseen" Warning
        "Swing and stance of the other foot were not detected within a cycle; it may have been off the plates."
        "Do not use the total force of this cycle.";
    FootfallsNone "footfalls.none" Warning
        "No stance phase was detected from the motion."
        "Check axes and units of the motion, and that feet touch the ground.";
    FootfallsBelt "footfalls.belt" Note
        "The floor moves under the feet, as on a treadmill; speeds of feet are relative to the belt."
        "Nothing to do.";
    // Ground forces and their prediction.
    GroundPredicted "ground.predicted" Note
        "Without measured forces the ground forces are predicted from the motion."
        "Give measured forces if there are any.";
    StancesPredicted "stances.predicted" Note
        "A loaded foot was not on a force plate, or only in part; moments, powers and reactions have predicted ground \
         forces there."
        "Nothing to do; `stances.csv` and the columns `ground_source` list these times.";
    StancesLegUnmeasured "stances.leg_unmeasured" Warning
        "A leg stood on force plates, but none of its stances was measured, while those of the other leg were: all its \
         moments, powers and reactions rest on predicted forces."
        "Do not use this leg as a measured one. Find out why its plate gave no load, or choose another trial.";
    StancesUnknown "stances.unknown" Warning
        "A loaded foot was not on a force plate, and its load cannot be predicted reliably."
        "Choose the time in which every loaded foot is on a plate; `stances.csv` lists the others.";
    ComparisonNone "comparison.none" Warning
        "No foot was alone and wholly on a plate, so the prediction could not be compared with force plates."
        "Nothing to do.";
    PredictionFeetUnseen "prediction.feet_unseen" Warning
        "No marker determines the direction of a foot: its stances, centre of pressure and moments are uncertain."
        "Put markers on heel and toe of both feet.";
    PredictionShort "prediction.short" Warning
        "The recording is shorter than a gait cycle; forces near its ends are uncertain."
        "Use a longer recording; `grf_sd.mot` has the standard deviations.";
    PredictionWeight "prediction.weight" Warning
        "The mean vertical force over whole cycles differs from the body weight."
        "Check unit, rate and filter of the motion, and that the ground alone carries the body.";
    PredictionImpulse "prediction.impulse" Warning
        "The fore-aft force does not agree with the change of the body's speed."
        "Check unit, rate and filter of the motion.";
    PredictionFriction "prediction.friction" Warning
        "A foot needs more friction than is available."
        "Check the motion of the feet and the stances.";
    PredictionPull "prediction.pull" Warning
        "The motion accelerates downwards faster than gravity, which no floor can cause."
        "Check unit and rate of the motion.";
    PredictionMotionSmoothed "prediction.motion_smoothed" Warning
        "The motion was smoothed so much before it was recorded that it does not show the foot strikes; predicted \
         forces are less accurate."
        "Use the markers as they were recorded, or filtered at 10 Hz or more.";
    PredictionFeetSlide "prediction.feet_slide" Warning
        "Loaded feet slide on the floor, so predicted forces are less accurate than their standard deviations state."
        "Refit the motion, or correct the angles of the legs.";
    RefitDone "refit.done" Note
        "The motion was changed so that loaded feet do not slide; the message states the change and the improvement."
        "Nothing to do.";
    RefitNone "refit.none" Warning
        "No foot is at rest on the floor, so the refit changed nothing."
        "Check axes and units of the motion, and that feet touch the ground.";
    PredictionOtherPerson "prediction.other_person" Warning
        "The calibration of the predicted forces and the recording name different persons; the calibration was used."
        "Calibrate with trials of this person, or correct the name of the subject in the files.";
    PredictionCalibrationUnusual "prediction.calibration_unusual" Warning
        "The calibration changes the predicted forces by more than three of their standard deviations, more than \
         people \
         differ."
        "Check the trials of the calibration: force plates, markers and mass.";
    PredictionCalibrationWorse "prediction.calibration_worse" Warning
        "Force plates of this recording show larger errors with the calibration than without it."
        "Leave the calibration out, or calibrate with trials of this person and this laboratory.";
    PredictionUntested "prediction.untested" Warning
        "The prediction of ground forces was never compared with force plates in this activity."
        "Use force plates, or treat ground forces and joint moments as estimates.";
    PredictionNotThroughTheFeet "prediction.not_through_the_feet" Warning
        "The motion needs forces that cannot act through the feet alone."
        "Check for a hand on a rail, a seat, a load that is carried, and errors of the motion.";
    // Motion and forces together.
    ResidualLarge "residual.large" Warning
        "Residual forces at the root are large: motion, forces and model do not agree, and joint moments cannot be \
         trusted."
        "Check files, sides and time origin; choose the time in which every loaded foot is on a plate.";
    ConsistencyIncompleteForces "consistency.incomplete_forces" Warning
        "Motion and forces disagree by more than half the body weight, as if a foot were on ground without a plate; \
         the motion was changed to agree."
        "Choose the time in which all forces were measured.";
    ConsistencyResidualLeft "consistency.residual_left" Warning
        "Within its tolerances the motion cannot agree with the forces: more than 1 % of body weight, or of body \
         weight times one metre, is left at the root."
        "Use wider tolerances or another mass, or check for forces that were not measured.";
    ConsistencyLargeChange "consistency.large_change" Warning
        "A coordinate was changed by more than the usual error of a motion, 2 degrees."
        "Check mass, body and forces.";
    ConsistencyForcesDoubted "consistency.forces_doubted" Note
        "Motion and forces agree within the limits of a change only if the forces may be wrong by two or five times \
         the usual accuracy of plates, 0.2 % of body weight."
        "Check the body mass and whether all forces were measured.";
    ConsistencyMotionKept "consistency.motion_kept" Warning
        "The motion agrees with the forces only if a joint turned by more than 30 degrees, or a body moved by more \
         than 30 mm, so it was not changed."
        "Check the body mass and whether all forces were measured.";
    ConsistencyNotSettled "consistency.not_settled" Warning
        "Residual reduction did not converge, so the motion was not changed."
        "Check mass, body and forces; wider tolerances may help.";
    TrackingResidualLeft "tracking.residual_left" Warning
        "Tracking did not remove the residual forces: more than 0.5 % of body weight is left at the root."
        "Choose a shorter time; check the size of the body, and whether anything but the feet supports the person.";
    TrackingLargeChange "tracking.large_change" Warning
        "Tracking changed the rotations by more than 5 degrees (rms), or one of them by more than 20: more than the \
         error of recorded motions."
        "Check mass, body and the motion of the feet; use predicted forces instead.";
    FeasibilityUnmeasuredSupport "feasibility.unmeasured_support" Note
        "Frames in which a foot may be on unmeasured ground were judged on predicted forces, or not at all without a \
         prediction."
        "Nothing to do.";
    // Synthetic walks and simulation.
    GaitSpeedRange "gait.speed_range" Warning
        "The speed is outside the range of walking; the joint curves of the nearest speed were used."
        "Choose a speed in the range.";
    WalkNotConsistent "walk.not_consistent" Warning
        "No small change makes this gait dynamically consistent; residual forces remain, and the verdict judges them."
        "Choose another speed, step length or style.";
    WalkReplayFell "walk.replay_fell" Note
        "Torques were replayed on the figure without feedback; the message states when it falls."
        "Nothing to do: torques without feedback do not keep a figure upright.";
    WalkReplayFigure "walk.replay_figure" Warning
        "The replayed torques were computed for a figure of another mass."
        "Use the figure that the torques were computed for, or compute torques for this one.";
    FigureFell "figure.fell" Warning
        "A figure that walks by its own torques fell: its pelvis is below 0.7 of its first height over the ground. Its \
         joints are then only damped, and the run ends 2 s after all such figures have fallen."
        "Nothing to do if it was meant to fall; otherwise lift its soles further (`lift`), push it less, or choose \
         another speed.";
    DriveGaveWay "drive.gave_way" Warning
        "A drive without a largest force would need more than 1,000 times the total weight; it gave way."
        "Prescribe a motion that the other constraints allow, or give the drive a largest force.";
    DriveAtLimit "drive.at_limit" Note
        "A drive reached its largest force or moment and does not follow its motion exactly."
        "Nothing to do if this is intended; otherwise allow a larger force.";
    StartContradictory "start.contradictory" Warning
        "The initial velocities contradict joints, drives or closed loops by more than 1 % (0.01 % of the kinetic \
         energy); the nearest consistent velocities are used."
        "Give velocities that the joints allow, or only the rates of their coordinates.";
    EnergyRose "energy.rose" Warning
        "The mechanical energy rose above that of the start, or of the last event, although nothing drives the scene."
        "Use a smaller time step, and remove overlaps and contradictory constraints.";
    ClosureOpen "closure.open" Warning
        "A loop closure is open although it had the time to close, or at the end: its points or axes cannot meet."
        "Check where the closure is fixed, and whether joints, drives and obstacles let its points meet.";
    BodyTooFast "body.too_fast" Warning
        "A body moves further in a time step than its own size, near a thin obstacle or another body; it may pass \
         through."
        "Use a smaller time step, or thicker obstacles.";
    ContactDeepOverlap "contact.deep_overlap" Warning
        "Two surfaces overlap deeply at the start and are pushed apart."
        "Correct the initial positions.";
    SolverNotConverged "solver.not_converged" Warning
        "The constraints of a time step could not all be satisfied."
        "Use a smaller time step, or remove constraints that contradict each other.";
    SolverWorkLimit "solver.work_limit" Warning
        "The work of a time step was used up before its constraints were satisfied; the nearest forces were used."
        "Use a smaller time step, and avoid masses, sizes and distances that differ by many orders of magnitude.";
    ContactNotRound "contact.not_round" Warning
        "Two bodies pass through each other, because their contact law needs a sphere or a capsule."
        "Use the regularised law.";
    ClosureRedundant "closure.redundant" Note
        "A loop closure repeats other constraints; of all possible forces, the least-squares solution is given."
        "Nothing to do, or remove the closure.";
    // Conversion of files and the report.
    ConvertAxes "convert.axes" Note
        "States the unit and the axes of a converted file."
        "Nothing to do.";
    ConvertDegrees "convert.degrees" Note
        "The file that was converted does not state the unit of its angles."
        "Add `inDegrees` to the header of the new file.";
    ConvertHeights "convert.heights" Warning
        "Force plates have different heights; every centre of pressure was moved to the height of the first."
        "Nothing to do if the differences are small.";
    ConvertLost "convert.lost" Note
        "Lists parts of the file that the new format cannot store."
        "Keep the original file.";
    ConvertRig "convert.rig" Note
        "States by how much the motion of a result differs from the animation file whose skeleton it was written into."
        "Nothing to do.";
    ConvertRigLimits "convert.rig_limits" Warning
        "Joints of an animation file lack the channels that a changed motion needs, so they keep or approximate it."
        "Give the joints that the message names three rotation channels (and the pelvis three position channels), and \
         export the file again.";
    ConvertOtherName "convert.other_name" Warning
        "A result was written into the skeleton of a file with another name than its source."
        "Check that both are the same take.";
    ReportNotWritten "report.not_written" Warning
        "The report page could not be written."
        "The message states the reason; all other results are complete.";
}

impl Code {
    /// Every code, in the order of the list.
    pub fn all() -> impl Iterator<Item = Code> {
        ENTRIES.iter().map(|entry| entry.code)
    }

    /// The stable name, such as `markers.swap`.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.entry().name
    }

    /// The code with this name; `None` if the name is unknown.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Code> {
        ENTRIES.iter().find(|entry| entry.name == name).map(|entry| entry.code)
    }

    /// Whether the finding is shown before other warnings: it concerns the identity of the person, or which values are
    /// results.
    #[must_use]
    pub fn comes_first(self) -> bool {
        matches!(
            self,
            Code::MarkersNotMeasured
                | Code::MarkersSidesExchanged
                | Code::MarkersByPlace
                | Code::MarkersUnused
                | Code::MarkersSegmentHardlyShown
                | Code::MarkersMoved
                | Code::CalibrationOtherLimbs
                | Code::CalibrationOtherPerson
                | Code::CalibrationPlaced
        )
    }

    /// How much the finding matters.
    #[must_use]
    pub fn severity(self) -> Severity {
        self.entry().severity
    }

    /// Meaning of the finding, in one sentence.
    #[must_use]
    pub fn meaning(self) -> &'static str {
        self.entry().meaning
    }

    /// Remedy, in one sentence, without reference to command, package or page.
    #[must_use]
    pub fn remedy(self) -> &'static str {
        self.entry().remedy
    }

    fn entry(self) -> &'static Entry {
        &ENTRIES[self as usize]
    }
}

impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl Serialize for Code {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

impl<'de> Deserialize<'de> for Code {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Code, D::Error> {
        let name = String::deserialize(deserializer)?;
        let unknown = || de::Error::custom(format!("unknown finding `{name}`; expected a code of docs/FINDINGS.md"));
        Code::from_name(&name).ok_or_else(unknown)
    }
}

#[cfg(feature = "schema")]
impl schemars::JsonSchema for Code {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Code".into()
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let names: Vec<&str> = Code::all().map(Code::name).collect();
        schemars::json_schema!({ "description": "What is unusual; docs/FINDINGS.md explains each code.",
            "type": "string", "enum": names })
    }
}
