#pragma once

#include <rrcb/stages.hpp>

#include <Teuchos_TimeMonitor.hpp>

#include <array>
#include <optional>
#include <string>

namespace rrcb::teuchos {

/// Times the stages of `balance` with Teuchos::TimeMonitor, as "RRCB: moments", "RRCB: gather", ...
///
/// Set Options::observer to it. Observers of one prefix share their timers, which every rank has
/// from the constructor on, so that Teuchos::TimeMonitor::summarize finds them everywhere. One
/// observer watches one call at a time.
class RRCB_API TimeMonitorObserver : public StageObserver {
  public:
    /// Makes the timers, whose names begin with `prefix`. Not collective.
    explicit TimeMonitorObserver(const std::string& prefix = "RRCB: ");
    void begin(Stage stage) noexcept override;
    void end(Stage stage) noexcept override;

  private:
    std::array<Teuchos::RCP<Teuchos::Time>, stages.size()> timers_;
    std::optional<Teuchos::TimeMonitor> running_;
};

}  // namespace rrcb::teuchos
