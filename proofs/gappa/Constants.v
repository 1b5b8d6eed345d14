(* SPDX-License-Identifier: Apache-2.0 *)
(** * The constants of the floating-point filters

    The theorems of this folder speak of these names.  The code has constants of
    the same names; tests/repository/proved_constants_test.cpp reads both and
    compares them as text, with [bpow radix2 (k)] for 0x1pk.  A comment that is
    only a path says in which file the constants after it are.

    Not here: what the constants mean (the files of the theorems). *)
Require Import Reals.
From Flocq Require Import Core.
Open Scope R_scope.

(* kernel/direction_filter.h *)
Definition u := bpow radix2 (-53).
Definition least_normal := bpow radix2 (-600).
Definition least_size := bpow radix2 (-300).
Definition vertex_face_units := 16.
Definition edge_edge_units := 60.

(* kernel/double_filter.h *)
Definition coplanarity_units := 176.
Definition coplanarity_level_units := 168.
Definition inside_units := 21.
Definition inside_difference_units := 25.
Definition inside_level_units := 25.

(* kernel/orientation.cpp *)
Definition error_2d := 2 * (3 + 16 * bpow radix2 (-53)) * bpow radix2 (-53).
Definition error_3d := 2 * (7 + 56 * bpow radix2 (-53)) * bpow radix2 (-53).
Definition underflow_2d := bpow radix2 (-1000).
Definition underflow_3d := bpow radix2 (-1060).

(* proofs/prover/cells/direction.h *)
Definition error_share := bpow radix2 (-49).
Definition error_least := bpow radix2 (-1022).
