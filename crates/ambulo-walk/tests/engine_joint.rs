//! Joint kinematics.

use ambulo_walk::engine::JointKind;
use ambulo_walk::internals::MOST;
use ambulo_walk::spatial::{Pose, Vec3, rotation};

#[test]
fn the_frame_of_a_child_is_the_product_of_its_parents_frame_and_its_joint() {
    let parent = Pose { rotation: rotation(&Vec3::new(0.3, -0.7, 1.1)), translation: Vec3::new(0.2, -0.4, 0.9) };
    let level = Pose::at(Vec3::new(0.1, 0.2, -0.3));
    let turned = Pose { rotation: rotation(&Vec3::new(0.0, 0.4, 0.0)), ..level };
    let q = [0.6, -0.2, 0.35, 0.1, 0.2, -0.1];
    let kinds = [JointKind::Weld, JointKind::Revolute, JointKind::Prismatic, JointKind::Universal];
    for kind in kinds.into_iter().chain([JointKind::Ball, JointKind::Planar, JointKind::Free]) {
        assert_eq!(kind.child_frame(&parent, &q), parent * kind.parent_from_child(&q), "{kind:?}");
    }
    for frame in [level, turned] {
        assert_eq!(parent.with(&frame), parent * frame);
        assert_eq!(parent.without(&frame), parent * frame.inverse());
    }
    assert_ne!(parent.with(&turned), parent.with(&level));
    assert_ne!(JointKind::Revolute.child_frame(&parent, &[-0.6; MOST]), JointKind::Revolute.child_frame(&parent, &q));
}
