//! Finds a marker of a set by its name, also if the name is written in another way.

use ambulo_body::internals::{NameIndex, Readings, RecordedName};
use ambulo_body::model::Side;
use ambulo_body::model::marker_set::MarkerSet;

#[test]
fn a_prefix_that_all_names_share_is_removed_but_never_a_side() {
    let plain = |names: &[&str]| RecordedName::all(names).into_iter().map(|name| name.rest.written).collect::<Vec<_>>();
    assert_eq!(plain(&["251112_KUO_LASI", "251112_KUO_RASI", "251112_KUO_C7", "251112_KUO_LKNE"])[0], "lasi");
    assert_eq!(plain(&["Anna:LASI", "Anna:RASI", "Bob:LKNE"]), ["lasi", "rasi", "lkne"]);
    assert_eq!(plain(&["R_knee", "R_ankle", "R_toe", "R_heel"])[0], "r_knee");
    assert_eq!(plain(&["P_R_knee", "P_R_ankle", "P_R_toe", "P_L_heel"])[0], "r_knee");
    assert_eq!(plain(&["r knee 1", "r asis", "l asis", "c7"])[0], "r knee 1");
    assert_eq!(plain(&["ä_LASI", "ä_RASI", "ä_LKNE", "ä_RKNE"])[3], "rkne");
}

#[test]
fn every_way_to_write_a_side_means_the_same() {
    let text =
        "name = \"one\"\n[[pair]]\nright = \"R.Knee.Lat\"\nleft = \"L.Knee.Lat\"\nlandmark = \"lateral_epicondyle\"\n";
    let set = MarkerSet::from_toml(text).unwrap();
    let index = NameIndex::new(&set);
    for name in [
        "R.Knee.Lat",
        "r_knee_lat",
        "RKneeLat",
        "knee_lat_r",
        "Knee.Lat.R",
        "right knee lat",
        "KneeLat-Right",
        "RT KNEE LAT",
    ] {
        assert_eq!(index.meant(&Readings::of(name)).and_then(|marker| marker.side), Some(Side::Right), "{name}");
    }
    for name in ["l_knee_lat_study", "KneeLat_L", "Left.Knee.Lat"] {
        assert_eq!(index.meant(&Readings::of(name)).and_then(|marker| marker.side), Some(Side::Left), "{name}");
    }
    for name in ["Knee.Lat", "R.Knee", "R", "L", "", "study"] {
        assert!(index.meant(&Readings::of(name)).is_none(), "{name}");
    }
    let is_written = |name: &str| index.written(&Readings::of(name)).is_some();
    assert!(is_written("r.knee.lat") && !is_written("r_knee_lat"));
}
