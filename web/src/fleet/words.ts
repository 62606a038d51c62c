/** Say what the fleet's page alone says, in both languages; what a robot's page says too is in i18n/. */
import { language } from "../i18n";
import type { Bilingual } from "../wire/types";

export const WORDS = {
  title: { en: "Pons: the fleet", zh: "Pons：车队" },
  answer: { en: "{n} of {all} robots answer", zh: "{all} 台机器人中 {n} 台有应答" },
  connecting: { en: "Connecting …", zh: "正在连接……" },
  lost: {
    en: "The fleet's service does not answer; what is shown is from {time}. To stop a robot, go to it or to its own page.",
    zh: "车队服务没有应答；显示的是 {time} 的情况。要停止机器人，请到它身边或打开它自己的页面。",
  },
  live: { en: "Live", zh: "实时" },
  silent: { en: "No answer", zh: "无应答" },
  viewer: {
    en: "This link may look and stop. Orders and answers need the operator's link.",
    zh: "此链接只能查看和停止；下命令和回答需要操作者的链接。",
  },
  "say.label": { en: "Say it to the house", zh: "对整个家说" },
  "say.placeholder": { en: "somebody look at the back door", zh: "谁去看看后门" },
  "say.send": { en: "Send", zh: "发送" },
  "say.hint": {
    en: "Who goes: “r1: …”, “somebody …”, “everybody …”, “everybody but r1 …”. Without a name the nearest goes.",
    zh: "谁去：“让r1……”“谁去……”“大家……”“除了r1以外大家都……”。不说名字则由最近的去。",
  },
  "token.title": { en: "The fleet asks for its access key", zh: "车队需要访问令牌" },
  "token.text": {
    en: "The owner has it: PONS_FLEET_TOKEN. It is kept until this tab is closed.",
    zh: "所有者知道：PONS_FLEET_TOKEN。它保存到关闭此标签页为止。",
  },
  "stop.all": { en: "Stop all", zh: "全部停止" },
  "stop.one": { en: "Stop {name}", zh: "停止 {name}" },
  "stop.asking": { en: "Stopping all …", zh: "正在全部停止……" },
  "stop.doubt": {
    en: "NOT confirmed yet: the fleet does not answer. Still asking.",
    zh: "尚未确认：车队没有应答。仍在请求。",
  },
  "stop.failed": {
    en: "NOT confirmed: the fleet does not answer. Stop the robots themselves.",
    zh: "未确认：车队没有应答。请在机器人上停止。",
  },
  "stop.repeats": {
    en: "It is told until it confirms; be with it if it may do harm.",
    zh: "会一直重复告知直到确认；如可能造成伤害，请到它身边。",
  },
  "stop.one_waits": { en: "has not confirmed a stop", zh: "尚未确认停止" },
  "map.show": { en: "On the map", zh: "看地图" },
  "map.label": { en: "Where the robots are", zh: "机器人的位置" },
  "map.keys": {
    en: "Map: plus and minus zoom, [ and ] turn, n turns north up, 0 shows all",
    zh: "地图：加减号缩放，[ 和 ] 旋转，n 恢复方向，0 显示全部",
  },
  "map.none": {
    en: "No robot has shown a map yet; the list tells where they are.",
    zh: "还没有机器人给出地图；位置见列表。",
  },
  "map.which": { en: "Which map", zh: "选择地图" },
  "robots.title": { en: "Robots", zh: "机器人" },
  "robots.none": {
    en: "There are no robots yet: pons fleet add https://ROBOT --token -",
    zh: "还没有机器人：请运行 pons fleet add https://机器人 --token -",
  },
  "robot.ready": { en: "ready", zh: "空闲" },
  "robot.busy": { en: "at work", zh: "执行中" },
  "robot.held": { en: "not able to drive", zh: "不能行驶" },
  "robot.connecting": { en: "connecting", zh: "正在连接" },
  "robot.quiet": { en: "not answering", zh: "没有应答" },
  "robot.unknown": { en: "unknown since {time}", zh: "{time} 起情况不明" },
  "robot.never": { en: "not heard yet", zh: "尚未联系上" },
  "robot.trouble": { en: "refused: {code}", zh: "拒绝：{code}" },
  "robot.battery": { en: "battery {share}", zh: "电量 {share}" },
  "robot.release": { en: "Pons {release}", zh: "Pons 版本 {release}" },
  "robot.page": { en: "{name}'s own page", zh: "{name} 自己的页面" },
  "robot.no_map": { en: "its map can't be shown ({code})", zh: "无法显示它的地图（{code}）" },
  "robot.no_place": { en: "does not know where it is", zh: "不知道自己在哪里" },
  "missions.title": { en: "Missions", zh: "任务" },
  "missions.none": { en: "Nothing was ordered yet.", zh: "还没有任务。" },
  "missions.past": { en: "Done before", zh: "已结束" },
  "mission.by": { en: "{who} · {time}", zh: "{who} · {time}" },
  "mission.nobody": { en: "nobody yet", zh: "还没有人去" },
  "mission.cancel": { en: "Cancel", zh: "取消" },
  "mission.give_up": { en: "Give up", zh: "放弃" },
  "mission.told_later": { en: "its robot tells now: {state}", zh: "机器人现在说：{state}" },
  "asks.title": { en: "{name} asks", zh: "{name} 有问题" },
  "state.waiting": { en: "waiting", zh: "等待中" },
  "state.offered": { en: "being told", zh: "正在交代" },
  "state.at_robot": { en: "at work", zh: "执行中" },
  "state.asking": { en: "asking", zh: "有问题" },
  "state.unknown": { en: "unknown", zh: "情况不明" },
  "state.succeeded": { en: "done", zh: "完成" },
  "state.failed": { en: "failed", zh: "失败" },
  "state.refused": { en: "refused", zh: "被拒绝" },
  "state.cancelled": { en: "cancelled", zh: "已取消" },
  "state.given_up": { en: "given up", zh: "已放弃" },
} as const satisfies Readonly<Record<string, Bilingual>>;

export type FleetKey = keyof typeof WORDS;

/** Return a sentence of the fleet's page with its blanks filled. */
export function ft(key: FleetKey, facts: Readonly<Record<string, string>> = {}): string {
  const sentence: string = WORDS[key][language.value];
  return sentence.replace(/\{(\w+)\}/g, (blank, name: string) => facts[name] ?? blank);
}

/** Name a mission's state; one that this page does not know stays as it came. */
export function stateWords(state: string): string {
  const key = `state.${state}`;
  return Object.hasOwn(WORDS, key) ? ft(key as FleetKey) : state;
}
