//! Muscles written into a document and read again.

use crate::muscle_models::{MODELS, MuscleModel, load, read};
use ambulo_body::model::to_osim;
use ambulo_muscles::set::MuscleSet;

/// The set with the poses of the surfaces of another one, if they agree to rounding.
fn with_poses_of(mut set: MuscleSet, other: &MuscleSet) -> MuscleSet {
    assert_eq!(set.wraps.len(), other.wraps.len());
    for (own, wanted) in set.wraps.iter_mut().zip(&other.wraps) {
        assert!((own.pose.rotation - wanted.pose.rotation).amax() < 1e-14, "{}", own.name);
        own.pose.rotation = wanted.pose.rotation;
    }
    set
}

#[test]
fn a_written_set_reads_back() {
    for name in MODELS.map(|(name, _)| name).into_iter().chain(["arm26", "ceinms"]) {
        let Some(MuscleModel { model, set, .. }) = load(name) else { return };
        let mut document = to_osim(&model).unwrap();
        set.write_into(&model, &mut document);
        let again = read(&document.write().unwrap());
        assert_eq!(with_poses_of(again.set.clone(), &set), set, "{name}");
        assert!(again.document.ignored.is_empty());
        // What is not written is not read.
        let bare = to_osim(&model).unwrap().write().unwrap();
        assert!(!String::from_utf8(bare).unwrap().contains("Muscle"));
    }
}

#[test]
fn a_scaled_set_reads_back() {
    let Some(MuscleModel { model, set, .. }) = load("gait2392") else { return };
    let factors = vec![ambulo_body::spatial::Vec3::new(0.9, 1.2, 1.05); model.bodies().len()];
    let scaled_model = model.scaled(&factors, None).unwrap();
    let scaled = set.scaled(&model, &scaled_model, &factors).unwrap();
    assert_ne!(scaled, set);
    let mut document = to_osim(&scaled_model).unwrap();
    scaled.write_into(&scaled_model, &mut document);
    assert_eq!(read(&document.write().unwrap()).set, scaled);
}
