// The history of the behaviour tree {tree}, written by btc for BehaviorTree.CPP 4.
#pragma once

#include <behaviortree_cpp/bt_factory.h>

#include <algorithm>
#include <cstddef>
#include <deque>
#include <set>
#include <string>
#include <utility>
#include <vector>

/// Keeps the last {held}.
///
/// What ends in a tick is asked for from the next tick on.
class History {
public:
    using Statuses = std::set<BT::NodeStatus>;

    /// Registers `done` and `failed`. The history has to live as long as the trees that ask it.
    {constructor}
        : last_(last), of_(std::move(of))
    {
        answer(factory, "done", BT::NodeStatus::SUCCESS);
        answer(factory, "failed", BT::NodeStatus::FAILURE);
    }
    History(const History&) = delete;
    History& operator=(const History&) = delete;

    /// Notes from now on how the behaviours of a tree end.
    void watch(const BT::Tree& tree)
    {
        const std::set<std::string> behaviors = {behaviors};
        for (const auto& subtree : tree.subtrees) {
            for (const auto& node : subtree->nodes) {
                if (behaviors.count(node->registrationName()) > 0) {
                    watched_.push_back(node->subscribeToStatusChange(
                        [this](BT::TimePoint, const BT::TreeNode& node, BT::NodeStatus,
                               BT::NodeStatus status) { note(node.name(), status); }));
                }
            }
        }
    }

    /// Takes in that a behaviour has ended.
    void note(const std::string& behavior, BT::NodeStatus status)
    {
        if (of_.count(status) > 0) {
            ended_.emplace_back(behavior, status);
        }
    }

    /// To be called before each tick.
    void beginTick()
    {
        window_.insert(window_.end(), ended_.begin(), ended_.end());
        ended_.clear();
        while (window_.size() > last_) {
            window_.pop_front();
        }
    }

private:
    using Termination = std::pair<std::string, BT::NodeStatus>;

    void answer(BT::BehaviorTreeFactory& factory, const std::string& id, BT::NodeStatus status)
    {
        const auto tick = [this, status](BT::TreeNode& node) {
            const Termination asked(node.getInput<std::string>("behavior").value(), status);
            const bool found = std::find(window_.begin(), window_.end(), asked) != window_.end();
            return found ? BT::NodeStatus::SUCCESS : BT::NodeStatus::FAILURE;
        };
        factory.registerSimpleCondition(id, tick, {BT::InputPort<std::string>("behavior")});
    }

    std::size_t last_;
    Statuses of_;
    std::deque<Termination> window_;
    std::vector<Termination> ended_;
    std::vector<BT::TreeNode::StatusChangeSubscriber> watched_;
};
