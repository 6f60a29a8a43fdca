#pragma once

#include <rrcb/balance.hpp>
#include <rrcb/controller.hpp>
#include <rrcb/cuts.hpp>
#include <rrcb/error.hpp>
#include <rrcb/ghosts.hpp>
#include <rrcb/groups.hpp>
#include <rrcb/neighbours.hpp>
#include <rrcb/options.hpp>
#include <rrcb/part_sizes.hpp>
#include <rrcb/plan.hpp>
#include <rrcb/points.hpp>
#include <rrcb/quality.hpp>
#include <rrcb/remap.hpp>
#include <rrcb/restart.hpp>
#include <rrcb/transfer.hpp>
#include <rrcb/version.hpp>
