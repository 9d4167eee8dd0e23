#pragma once

#include <functional>
#include <string>

#include "mesher/base/parallel/shared_stage.hpp"
#include "quadloop/case/case_input.hpp"
#include "quadloop/quadloop.hpp"

/// What the files of this folder share.
namespace quadloop {

struct CaseParts {
  CaseInput input;
  CaseArguments arguments;
  Warnings warnings;
};

inline const MeshInput& mesh_input(const Case& of) { return *of.parts().input.mesh; }

inline const std::string& path_of(const Case& of) { return of.parts().arguments.source.path; }

/// Passes stages on to a callback, which must outlive the observer. `cycle` returns the cycle under way.
progress::Observer observer_of(const ProgressCallback& callback, const std::function<int()>& cycle = {});

}  // namespace quadloop
