#include <rrcb/teuchos/time_monitor.hpp>

namespace rrcb::teuchos {

TimeMonitorObserver::TimeMonitorObserver(const std::string& prefix) {
    for (const Stage stage : stages) {
        auto& timer = timers_[static_cast<std::size_t>(stage)];
        const std::string name = prefix + name_of(stage);
        timer = Teuchos::TimeMonitor::lookupCounter(name);
        if (timer.is_null()) timer = Teuchos::TimeMonitor::getNewCounter(name);
    }
}

void TimeMonitorObserver::begin(Stage stage) noexcept {
    try {
        running_.emplace(*timers_[static_cast<std::size_t>(stage)]);
    } catch (...) {
        running_.reset();  // balances without a timer
    }
}

void TimeMonitorObserver::end(Stage) noexcept {
    running_.reset();
}

}  // namespace rrcb::teuchos
