//! Where bodies touch, the Coulomb cone, rigid and compliant laws.
