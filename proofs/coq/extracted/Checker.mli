(* SPDX-License-Identifier: Apache-2.0 *)
(* Extracted from Checker.v by build.sh --renew: not to be edited. *)
open Spec

type group =
| Cell of Zint.t
| Join of group * group

type halfspace = { normal : vec; nt : Zint.t; nd : Zint.t }

type way = (Zint.t * Zint.t) list

type token =
| THalve
| TLeft
| TRight
| TDrop of Zint.t
| TRing of Zint.t * way list
| TFar
| TPlane of halfspace * Zint.t
| TDirection of vec
| TExcluded
| TParts
| TOne
| TBoth

val reaches : Zint.t -> Zint.t -> (Zint.t * 'a1) list -> bool

val wf_traj : Zint.t -> Zint.t -> traj -> bool

val equal_traj : traj -> traj -> bool

type 'a search =
| Found of 'a
| Choose of Zint.t * 'a search * 'a search

val find : (Zint.t -> bool) -> 'a1 search -> 'a1

val join_pairs :
  (Zint.t * 'a1 search) list -> (Zint.t * 'a1 search) list -> (Zint.t * 'a1
  search) list

val join_all : 'a2 list -> (Zint.t * 'a1 search) list -> 'a1 search option

val suffixes :
  traj -> (Zint.t * traj search) list -> (Zint.t * traj search) list

val index : traj -> traj search

val since : Zint.t -> Zint.t -> traj search -> traj

val dot : vec -> vec -> Zint.t

val value : halfspace -> Zint.t -> vec -> Zint.t

val opposite : vec -> vec

val behind : halfspace -> Zint.t -> halfspace

val wide : Zint.t -> vec -> Zint.t -> bool

val segment_positive :
  Zint.t -> Zint.t -> Zint.t -> Zint.t -> Zint.t -> Zint.t -> bool

val inside_from :
  halfspace -> Zint.t -> Zint.t -> Zint.t -> Zint.t -> Zint.t -> traj -> bool

val inside : halfspace -> Zint.t -> Zint.t -> Zint.t -> traj search -> bool

val lesser : Zint.t -> Zint.t -> Zint.t

val greater : Zint.t -> Zint.t -> Zint.t

val by_axis : (Zint.t -> Zint.t -> Zint.t) -> vec -> vec -> vec

type chord = { grain : Zint.t; origin : vec; motion : vec; lows : vec;
               highs : vec }

val unit_bits : (Zint.t -> traj) -> Zint.t list -> Zint.t

val last_from : Zint.t -> 'a1 -> (Zint.t * 'a1) list -> Zint.t * 'a1

val part : Zint.t -> Zint.t -> Zint.t

val stray : Zint.t -> Zint.t -> vec -> vec -> Zint.t -> vec -> vec

val slack : Zint.t -> Zint.t

val strays :
  ('a1 -> vec) -> Zint.t -> Zint.t -> vec -> vec -> (Zint.t * 'a1) list ->
  vec -> vec -> vec * vec

val chord_by :
  ('a1 -> vec) -> Zint.t -> Zint.t -> Zint.t -> (Zint.t * 'a1) list -> chord
  option

val word_lesser : int -> int -> int

val short : Zint.t -> vec -> bool

type band = { grid : Zint.t; lx : int; ly : int; lz : int; hx : int;
              hy : int; hz : int; mx : int; my : int; mz : int }

val band_of : chord -> band option

type vertex = { vid : Zint.t; delayed_trail : traj search Lazy.t;
                line : band option }

val trail : vertex -> traj search

val least_on : int -> int -> int -> int

val least_from :
  int -> int -> int -> int -> int -> vertex list -> int -> int -> (int * int)
  option

val least_of : vec -> Zint.t -> Zint.t -> vertex list -> (int * int) option

val grain_of : vertex list -> Zint.t option

val apart_by_bounds :
  Zint.t -> Zint.t -> Zint.t -> vec -> Zint.t -> Zint.t -> Zint.t -> vertex
  list -> vertex list -> bool

type rat = Zint.t * Zint.t

val rat_lt : rat -> rat -> bool

val rat_over : Zint.t -> rat -> rat -> bool

val rat_min : rat -> rat -> rat

val between : Zint.t -> Zint.t -> Zint.t -> Zint.t -> Zint.t -> rat

val along :
  vec -> Zint.t -> Zint.t -> Zint.t -> Zint.t -> traj -> Zint.t -> Zint.t
  list -> rat list -> rat list option

val values :
  vec -> Zint.t -> Zint.t -> Zint.t -> Zint.t list -> traj search -> rat list
  option

val times_until :
  Zint.t -> Zint.t -> Zint.t -> traj -> Zint.t list -> Zint.t list

val times : Zint.t -> Zint.t -> Zint.t -> traj search -> Zint.t list

val union_acc :
  ('a1 -> Zint.t) -> 'a1 list -> 'a1 list -> 'a1 list -> 'a1 list

val union : ('a1 -> Zint.t) -> 'a1 list -> 'a1 list -> 'a1 list

val lower_acc : rat list -> rat list -> rat list -> rat list

val lower : rat list option -> rat list option -> rat list option

val all_less : Zint.t -> rat list -> rat list -> bool

val apart_by_walk :
  Zint.t -> vec -> Zint.t -> Zint.t -> Zint.t -> vertex list -> vertex list
  -> bool

val apart_by_plane :
  Zint.t -> halfspace -> Zint.t -> Zint.t -> Zint.t -> Zint.t -> vertex list
  -> vertex list -> bool

val floor_at : vec -> Zint.t -> Zint.t -> traj search -> Zint.t

val least_at : vec -> Zint.t -> Zint.t -> vertex list -> Zint.t

val plane_between :
  Zint.t -> vec -> Zint.t -> Zint.t -> Zint.t -> vertex list -> vertex list
  -> halfspace * Zint.t

val empty : vertex list -> bool

val separated :
  Zint.t -> Zint.t -> Zint.t -> vec -> Zint.t -> Zint.t -> Zint.t -> vertex
  list -> vertex list -> bool

type tree =
| Leaf of Zint.t * vertex list
| Node of Zint.t option * vertex list * tree * tree

val at_most : Zint.t -> 'a1 list -> bool

val own : tree -> vertex list

val few_of : tree -> tree -> vertex list

val collect : tree -> vertex list -> vertex list

val verts : tree -> vertex list

val label_of : tree -> Zint.t option

val common_label : tree -> tree -> Zint.t option

val cell_ids : (Zint.t -> Zint.t) -> scene -> Zint.t -> Zint.t list

val group_ids : (Zint.t -> Zint.t) -> scene -> group -> Zint.t list

val vertices :
  (Zint.t -> vertex) -> Zint.t list -> (Zint.t * vertex search) list ->
  (Zint.t * vertex search) list

val look_up : vertex search -> Zint.t -> vertex option

val look_up_all : vertex search -> Zint.t list -> vertex list option

val build_from : vertex search -> scene -> group -> tree option

val build_by :
  (Zint.t -> bool) -> (Zint.t list -> Zint.t) -> (Zint.t -> Zint.t -> vertex)
  -> scene -> group -> tree option

val ids_of : group -> Zint.t list

val size : group -> Zint.t

val is_range : Zint.t -> Zint.t -> Zint.t list -> bool

val covers : Zint.t -> group -> bool

val excluded_pair : scene -> Zint.t -> Zint.t -> bool

val excluded_labels : scene -> Zint.t option -> Zint.t option -> bool

val has : Zint.t -> vertex list -> bool

val without : Zint.t -> vertex list -> vertex list

val nth_id : Zint.t -> vertex list -> Zint.t option

val in_cell : scene -> Zint.t -> Zint.t -> bool

val way_end : scene -> Zint.t -> Zint.t -> way -> Zint.t option

val way_ends : scene -> Zint.t -> Zint.t -> way list -> Zint.t list option

val without_all : Zint.t list -> vertex list -> vertex list

type mode =
| Distance
| Far
| Disjoint

type obligation =
| Pair of tree * tree * mode * Zint.t * Zint.t * Zint.t
| Self of tree * mode * Zint.t * Zint.t * Zint.t

val least : scene -> mode -> Zint.t

val step_pair :
  scene -> tree -> tree -> mode -> Zint.t -> Zint.t -> Zint.t -> obligation
  list -> token -> obligation list option

val step_self :
  bool -> scene -> tree -> mode -> Zint.t -> Zint.t -> Zint.t -> obligation
  list -> token -> obligation list option

val step : bool -> scene -> obligation list -> token -> obligation list option

val start_by :
  (group -> tree option) -> scene -> group -> obligation list option
