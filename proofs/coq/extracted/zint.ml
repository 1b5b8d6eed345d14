(* SPDX-License-Identifier: Apache-2.0 *)
(* Zarith's integers under a name that the extraction does not use itself. *)
include Z

(* 2^1024, as d_max in Checker.v *)
let d_max = shift_left one 1024
