/** List the owner's skills: what each is called, what it takes, its file; and what is wrong in others. */
import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { language, say, t } from "../i18n";
import { call } from "../net/api";
import type { Bilingual } from "../wire/types";

type Parameter = {
  readonly name: string;
  readonly kind: "place" | "thing" | "person" | "words" | "number" | "duration";
  readonly default: string | null;
};

type Skill = {
  readonly name: string;
  readonly file: string;
  readonly kind: "routine" | "function";
  readonly about: string;
  readonly en: readonly string[];
  readonly zh: readonly string[];
  readonly parameters: readonly Parameter[];
};

type Skills = {
  readonly folder: string;
  readonly skills: readonly Skill[];
  readonly problems: readonly {
    readonly file: string;
    readonly line: number;
    readonly code: string;
    readonly message: Bilingual;
  }[];
};

const LOOK_MS = 3000; // a person who writes a file sees here soon whether it is right

const known = signal<Skills | null>(null);

async function look(): Promise<void> {
  known.value = await call("GET", "v1/skills").then(
    (list) => list as Skills,
    () => known.value,
  );
}

export function SkillsPanel() {
  useEffect(() => {
    void look();
    const timer = setInterval(() => void look(), LOOK_MS);
    return () => clearInterval(timer);
  }, []);
  const list = known.value;
  if (list === null) return null;
  return (
    <section class="card" aria-labelledby="skills-title" id="skills">
      <h2 id="skills-title">{t("skills.title")}</h2>
      <p class="fine">{t("skills.how")}</p>
      {list.problems.length > 0 && (
        <ul class="taught" aria-label={t("skills.broken")}>
          {list.problems.map((each) => (
            <li key={`${each.file}:${each.line}`} data-problem={each.code}>
              <span class="said">
                <strong class="wrong">
                  {t("skills.at", { file: each.file, line: `${each.line}` })}
                </strong>
                <span dir="auto">{say(each.message)}</span>
              </span>
            </li>
          ))}
        </ul>
      )}
      {list.skills.length > 0 && (
        <ul class="taught">
          {list.skills.map((skill) => (
            <Line key={skill.name} skill={skill} />
          ))}
        </ul>
      )}
      <p class="fine">{t("skills.folder", { folder: list.folder })}</p>
    </section>
  );
}

function Line({ skill }: { readonly skill: Skill }) {
  const [own, other] = language.value === "zh" ? [skill.zh, skill.en] : [skill.en, skill.zh];
  return (
    <li data-skill={skill.name}>
      <span class="said">
        {(own.length > 0 ? own : other).map((words) => (
          <strong key={words} dir="auto">
            {words}
          </strong>
        ))}
        {skill.about !== "" && <span dir="auto">{skill.about}</span>}
        {skill.parameters.map((each) => (
          <span key={each.name} class="fine">
            {`{${each.name}}: ${t(`skills.kind.${each.kind}`)}`}
            {each.default !== null && ` (${t("skills.else", { value: each.default })})`}
          </span>
        ))}
        <span class="fine">{t(`skills.${skill.kind}`, { file: skill.file })}</span>
      </span>
    </li>
  );
}
