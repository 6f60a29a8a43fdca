#pragma once

#include <rrcb/balance.hpp>
#include <rrcb/bisection.hpp>
#include <rrcb/cuts.hpp>
#include <rrcb/error.hpp>
#include <rrcb/ghosts.hpp>
#include <rrcb/moments.hpp>
#include <rrcb/options.hpp>
#include <rrcb/plan.hpp>
#include <rrcb/points.hpp>
#include <rrcb/quality.hpp>
#include <rrcb/remap.hpp>
#include <rrcb/stages.hpp>
#include <rrcb/statistical_domain.hpp>
#include <rrcb/support_mesh.hpp>
#include <rrcb/transfer.hpp>
#include <rrcb/version.hpp>
