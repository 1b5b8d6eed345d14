// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/step_record.h"

namespace noli {

void StepRecord::tell(const Step& step, StepSink& sink) {
  switch (step.kind) {
    case Kind::split_self: return sink.split_self();
    case Kind::split_first: return sink.split_first();
    case Kind::split_second: return sink.split_second();
    case Kind::drop_vertex: return sink.drop_vertex(step.vertices[0]);
    case Kind::halve: return sink.halve();
    case Kind::direction: return sink.direction(step.n);
    case Kind::empty: return sink.empty();
    case Kind::cell: return sink.cell();
    case Kind::apart: return sink.decided(step.pair, step.vertices, false);
    case Kind::contact: return sink.decided(step.pair, step.vertices, true);
    case Kind::apart_at_begin: return sink.at_begin(false);
    case Kind::meets_at_begin: return sink.at_begin(true);
    case Kind::features: return sink.features();
  }
}

void StepRecord::play(std::size_t begin, std::size_t end, StepSink& sink) const {
  for (std::size_t i = begin; i < end; ++i) tell(steps_[i], sink);
}

}  // namespace noli
