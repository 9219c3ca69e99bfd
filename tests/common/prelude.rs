//! What most tests name: a file of tests says `use crate::prelude::*;` once.

pub use crate::common::tolerances::*;
pub use crate::common::{
    CollectVec, Largest, alter,
    answer::{Answer, answer, answered},
    appendix_b::{mass_norm, modes, relative_difference, slight_overlap, unit_shapes},
    appendix_c::{
        FORMULAE, ModalChange, ascending, change_of, eigensolution, exact, four_modes,
        largest_change, largest_root_error, of_stiffness, on_either_side, original, recursive_2,
        separate_change, separate_spectrum, stiffness_rules, three_mass_chain,
    },
    assert_alike, assert_refused, assert_within,
    boxes::{first_problem, other_boxes, problem_of, uneven_box},
    by_sorting, case_of, case_run,
    closed_forms::{
        analytical::{
            ChainEnds, chain_eigenvalues, no_sides_parallel_energy, parallelogram_energy,
            sides_12_34_parallel_energy, sides_14_23_parallel_energy,
        },
        uniform_chain::uniform_held_modes,
    },
    complex_pencils::{Complexes, amax, complex, roots_by_qz, through},
    condensed::{analyze_condensed, condensed},
    costly_config,
    decks::{bulk_data, bulk_text, read_deck},
    delta_wing::{self, GROUPS, first_model},
    diagonal,
    draws::{Draws, reached},
    eye,
    golden::{Numbers, assert_golden, assert_table, on_file},
    ground_tests::{ground_test, wing_test},
    in_root,
    jobs::{
        Files, STORIES, about, analyses, building, comparing, file, finished, measured_building,
        new_folder, of_matrices, placed, prepare, prepared, report_of, retested, rods, rods_with,
        supposing, trust_in, with, worked,
    },
    known::{Known, Weighed},
    log_log_slope,
    loops::{
        Eigensolved, assert_error_sum_only_falls, assert_limits_hold, by_factor, chain_problem,
        correlate_chain, exact_state, given, inner_for_modes, verdict_of,
    },
    matrices::relative_distance,
    measured::{
        equal_weights, free_beam, free_truss, held_chain, mixture, noise, orthonormal_modes,
        with_raw_shapes,
    },
    nastran95::{boxes, snap_factor},
    not_definite,
    outer_loop::{
        assert_near, paired_hz,
        program::{Nastran95, correlate_case, default_folder, read_output5},
        stored, stored_wing,
    },
    pairings::{cross, noisy_pairs, pairs_by_sorting, rearrangement},
    panels::{Sample, flat_panel, material, sample, warped_panel},
    relative_error, said,
    strategies::{orthogonal, point, positive_definite, rotation, symmetric},
    structures::{
        condition, dense, factorized, grid, linkage, linkage_data, lumped_mass, sizes, sizes_of,
        spring_chain, spring_stiffness,
    },
    test_files::{write_csv, write_universal},
    torque_boxes::{case, factors, with_every_element, with_parameters},
    vibrations::{
        Chain, any_change, chain, chain_and_truth, error_sum_by_definition, modes_by_nalgebra,
        pencil,
    },
    whole_models::{
        chain_of_springs, counted_modes, free_motions, lowest_modes, masses, of_dense, seen_by,
        sensors_at, shear_building, sparse, springs,
    },
    whole_parameter,
    wing::{
        Wing,
        whole::{self, of_elements},
    },
    zero_square,
};
pub use approx::assert_relative_eq;
pub use corfem::{
    files::{
        deck::{
            self, BulkData, Reason, Tie, Unread,
            number::{large_real, nearest_in_field},
            rewrite,
        },
        error::FileError,
        matrices::{self, write_matrix_market},
        test_data::{self, Sensor, TestData, read},
    },
    job::{
        Concern, History, JobResult, PreparedJob, Trust,
        localization::{Suspect, by_single_fit},
        preflight::{FACTORS, SeenModes, measured_once, preflight_at_sensors},
        verdict::{End, Verdict},
    },
    method::{
        analysis::{Analysis, State},
        appendix_a::{
            Condensed, ElementMatrix, assemble, condense, dynamic_mass, element_matrices,
            generalized_stiffness,
        },
        appendix_b::{
            ANTISYMMETRIC, LARGEST_SUSPENSION_RATIO, MeasuringPoint, Movement, MovementLimits,
            SYMMETRIC, Supports, balance, examine, orthogonalize, rigid_body_vectors,
        },
        appendix_c::{self, LeftRightModes, Pencil},
        changed_modes::changed_modes,
        derivatives::{DERIVATIVE_STEP, error_change, without_close_couplings},
        elements::{
            corner_forces, energy_coefficient, mean_plane, membrane, rod, shear_panel, triangle,
            unit_stiffness,
        },
        error::Error,
        error_sum::{Errors, ModeError, errors, mode_errors},
        inner_loop::{InnerRun, InnerSettings, Stop, first_factors, run},
        linear_algebra::{
            check_finite, check_shape, check_symmetric, cholesky, symmetric_eigen, symmetric_part,
        },
        model::{DynamicModel, FiniteElementModel, ModalModel, Parameter},
        modes::{Modes, apply_sign_rule, generalized_mass, solve},
        outer_loop::{Correlation, Pass, Settings, correlate},
        perturbation::{
            LARGEST_ROOT_ERROR, LARGEST_UNSETTLED_CHANGE, MOST_ORDERS, Perturbed, ROOT_TOLERANCE,
            SMALLEST_SEPARATION, first_order, recursive_1, recursive_1_converged,
        },
        sorting::{Pairing, cross_orthogonality, pair_modes},
        step::{
            Bounds, LEAST_SHARE, REFERENCE_GAGE, StepRule, limited_factor, next_share_factor,
            unlimited_factor,
        },
        structure::{
            DIRECTIONS, Element, ElementKind, Grid, Material, Point, StructuralDof, Structure,
            check_corners,
        },
    },
    present::{
        PresentError,
        check::check_tables,
        compared::Derivatives,
        render::{self, csv, text},
        report::Report,
        table::{Cell, Digits, Table, numbers},
    },
    sparse::{
        CountedModes, FINITE, Factor, MOST_DENSE_ROWS, ModeWeight, Pair, ParameterMatrix,
        RigidBodies, SensorModel, SparseMatrix, Support, WholeModel, WholeParameter, WholeShare,
        elements::{corner_volumes, lumped_masses, support},
        modal_assurance, normalize_with_mass, pair_optimally,
        random::split_mix_64,
    },
    torque_box::{
        CASES, Case, CaseResult, Grouping,
        error::CaseError,
        fewer_modes::{PUBLISHED_CASE, PUBLISHED_RUNS, published_runs},
        published::PublishedTable,
        published_passes, run_case, stands_out,
        table_1::TwoMasses,
        wing_box::{
            COVERS, PANEL_COUNT, Reconstruction, TEST_GAGE, dynamic_points, gage_rms,
            load_distribution, rms, structure,
        },
    },
    weighted::{
        close_modes::{assurance_of_roots, indistinct_groups, turned},
        comparison::{Comparison, ExactResult, LoneFrequency, ModeErrors},
        gauss_newton::{WeightedCorrelation, WeightedSettings, WeightedStop, gauss_newton},
        identifiability::{NORMAL_95, identifiability},
        intervals::{Withheld, intervals},
        misfit::Misfit,
        next_step::NextStep,
        noise::{Noise, with_noise, with_noise_by_mode},
        residuals::{DEVIATIONS, jacobian, residuals},
        starts::{WeightedHistory, from_several_starts},
    },
};
pub use nalgebra::{
    Complex, DMatrix, DVector, Matrix3, Rotation3, SymmetricEigen, Vector2, Vector3, dmatrix,
    dvector,
};
pub use proptest::prelude::*;
pub use proptest::{
    strategy::{Strategy, ValueTree},
    test_runner::{Config, TestRunner},
};
pub use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};
pub use rustix::process::Signal;
pub use serde::Deserialize;
pub use serde_json::{Value, json};
pub use std::{
    collections::{BTreeMap, BTreeSet},
    f64::consts::{PI, TAU},
    fmt::{Debug, Display},
    fs,
    iter::once,
    ops::{Range, RangeInclusive},
    panic::{AssertUnwindSafe, catch_unwind},
    path::{Path, PathBuf},
    process::{Command, Stdio},
    slice::from_ref,
    sync::{LazyLock, OnceLock, atomic::Ordering},
    time::{Duration, Instant},
};
pub use tempfile::TempDir;
