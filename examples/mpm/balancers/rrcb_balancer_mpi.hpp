#pragma once

#include <rrcb/options.hpp>
#include <rrcb/paper.hpp>

#include <mpm/decomposition.hpp>

/// Balancer by rrcb::balance, collective as that is.
mpm::Balancer rrcb_balancer(const rrcb::Options& options = {});

/// Balancer by rrcb::balance_as_in_paper, collective as that is.
mpm::Balancer rrcb_balancer(const rrcb::PaperOptions& options);
