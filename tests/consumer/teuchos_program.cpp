// The headers for Teuchos, twice, and the library behind them.
#include <rrcb/teuchos/parameters.hpp>
#include <rrcb/teuchos/time_monitor.hpp>

int main() {
    Teuchos::ParameterList list;
    list.set("RRCB_SUPPORT_MESH", 6);
    rrcb::Options options = rrcb::teuchos::options_from(list);
    rrcb::teuchos::TimeMonitorObserver observer;
    options.observer = &observer;
    return options.tuning.support_mesh == 6 ? 0 : 1;
}
