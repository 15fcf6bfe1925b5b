//! Predicted centres of pressure of people who stand: against force plates, and where the mass centre is known.

use crate::plug_in_gait::PEOPLE;
use crate::shared_data::data;
use ambulo::findings::Findings;
use ambulo::spatial::Vec3;
use ambulo::study::{self, GroundSettings, Outcome, Recording, Settings, Source, Tracking};

/// The standing trial of a person, analysed as a motion.
fn standing(source: &Source) -> Option<Outcome> {
    let mut source = source.clone();
    let Recording::Markers(markers) = &mut source.recording else { panic!("no markers") };
    markers.trial = markers.standing.clone()?;
    let settings = Settings { ground: GroundSettings::Predicted, ..Settings::default() };
    study::run(&source, &settings, &mut Findings::default()).ok()
}

/// Centre of pressure of the feet together, and of the plates together, averaged over the recording.
fn centers(outcome: &Outcome) -> Option<[Vec3; 2]> {
    let up = outcome.body.up();
    let Some(Tracking::Markers(tracked)) = &outcome.tracking else { panic!("no markers") };
    let weighted = |points: Vec<(f64, Vec3)>| {
        let load: f64 = points.iter().map(|(load, _)| load).sum();
        (load > 0.0).then(|| points.iter().map(|(load, point)| *point * *load).sum::<Vec3>() / load)
    };
    let grid = outcome.analysis.trajectory.grid();
    let feet = outcome.analysis.ground.bodies.iter().flat_map(|foot| {
        (0..grid.frames).map(|i| (foot.force[i].dot(&up), foot.center_of_pressure[i])).filter(|(load, _)| *load > 20.0)
    });
    let plates = tracked.body.plates.iter().flat_map(|plate| {
        let loaded = (0..plate.times.len()).filter(|i| plate.vertical(*i) > 50.0);
        loaded.map(|i| (plate.vertical(i), plate.center_of_pressure(i)))
    });
    Some([weighted(feet.collect())?, weighted(plates.collect())?])
}

#[test]
fn standing_people_have_their_centre_of_pressure_where_plates_measure_it() {
    let Some(folder) = data() else { return };
    let mut errors_mm = Vec::new();
    for person in &PEOPLE {
        let Some(outcome) = standing(&person.source(&folder)) else { continue };
        let Some([feet, plates]) = centers(&outcome) else { continue };
        let up = outcome.body.up();
        let apart = feet - plates;
        let level = apart - up * apart.dot(&up);
        println!(
            "standing: centre of pressure off by {:.0} mm (x {:.0}, z {:.0})",
            1e3 * level.norm(),
            1e3 * level.x,
            1e3 * level.z
        );
        errors_mm.push(1e3 * level.norm());
    }
    assert!(!errors_mm.is_empty());
    let mean = errors_mm.iter().sum::<f64>() / errors_mm.len() as f64;
    println!("standing: mean {mean:.0} mm over {} people", errors_mm.len());
    assert!(mean < 30.0, "{errors_mm:?}");
}
