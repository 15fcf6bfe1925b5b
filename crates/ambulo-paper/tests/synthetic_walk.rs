//! The mode `paper` of synthetic walks against the walk whose claims are judged.

use ambulo_body::findings::Findings;
use ambulo_body::model::anthropometry::{Build, SegmentTable};
use ambulo_paper::{Footwear, Setting, TrialSettings};
use ambulo_walk::gait::Gait;
use ambulo_walk::synthetic::{SyntheticMode, SyntheticWalkSettings, synthesise};

#[test]
fn the_papers_mode_is_the_one_whose_claims_are_judged() {
    let build = Build { table: SegmentTable::Faure1997, mass: 80.0, height: 1.8, toe_joint: false };
    let (gait, human) = (Gait::named("standard").unwrap(), build.human().unwrap());
    let settings = SyntheticWalkSettings { gait: &gait, build, mode: SyntheticMode::Paper, cycles: 2, rate_hz: 100.0 };
    let walk = synthesise(&settings, &mut Findings::default()).unwrap();
    let trial =
        TrialSettings { gait: &gait, human: &human, shoes: Footwear::Own, friction: 1.0, rate_hz: 1000.0, cycles: 5 };
    let setting = Setting::named("schwartz-children").unwrap().unwrap();
    let judged = setting.walk(&trial).unwrap().recording;
    let forward = human.model.coordinate("pelvis_tx").unwrap();
    let (short, long) = (walk.trajectory.values(forward), judged.trajectory.values(forward));
    let first = long.iter().position(|x| x.to_bits() == short[0].to_bits()).unwrap();
    for id in human.model.coordinate_ids() {
        for (n, effort) in walk.efforts[id.index()].iter().enumerate() {
            assert_eq!(effort.to_bits(), judged.efforts[id.index()][first + 10 * n].to_bits(), "frame {n}");
        }
    }
}
